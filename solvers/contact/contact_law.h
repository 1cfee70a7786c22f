#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/contact_accuracy.h>
#include <dalembert/solvers/contact/coupling.h>

#include <Eigen/Core>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

// What impacts and accelerations of touching contacts have in common: U, or dU/dt, by Coupling.

/// The units that make rates of different contacts comparable.
[[nodiscard]] Eigen::VectorXd units(const Eigen::MatrixXd& S);

/// Sets to 0 what is round-off of the largest, each in its own unit.
void clear_round_off(Eigen::VectorXd& x, const Eigen::VectorXd& unit, double largest);

/// Of the contacts that touch, those at these places.
[[nodiscard]] std::vector<std::size_t> those_at(const Coupling::Places& places,
                                                const std::vector<std::size_t>& touching);

/// A flag for each of `size` contacts: whether it is among these.
[[nodiscard]] std::vector<char> marks(const std::vector<std::size_t>& which, std::size_t size);

/// S of contacts of one island. Gradients are known to the rounding of positions over the scene's length:
/// what couples two contacts by no more is none.
[[nodiscard]] Eigen::MatrixXd coupled(const Coupling& coupling, const Coupling::Places& places,
                                      const Scales& scales, double rounding);

/// How these contacts act on each other, with no other contacts in force. Throws as Coupling.
[[nodiscard]] std::unique_ptr<Coupling> coupling_of(const System& stated,
                                                    std::span<const ContactState> contacts,
                                                    const std::vector<std::size_t>& which, const Instant& at);

/// Of these contacts, coupled so, keeps the first `own` ones and those that an impulse at these reaches,
/// through others or not: beside a floor on which hops end, a wall across it goes on being struck.
void keep_reached(const Coupling& coupling, std::size_t own, const Scales& scales, double rounding,
                  std::vector<std::size_t>& contacts);

/// Throws StepFailure, naming these contacts.
[[noreturn]] void refuse(const System& stated, std::span<const ContactState> contacts,
                         const std::vector<std::size_t>& which, double t, const std::string& what);

}  // namespace dalembert
