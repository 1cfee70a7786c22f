#pragma once

#include <dalembert/core/results/sample.h>
#include <dalembert/solvers/audit/findings.h>
#include <dalembert/solvers/audit/limits.h>

#include <memory>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The laws that hold at an instant, see Law, by a sample's own numbers: what is evaluated here are the
/// equations that the scene states. Which one-sided and rough constraints act is read off their forces.
/// A law that reads a number which is not determined (NaN) is passed over.
class SampleLaws {
 public:
  SampleLaws(std::shared_ptr<const System> stated, const Claim& claim);

  /// Throws EquationFault.
  void check(const FlatSample& sample, const Claim& claim, Findings& findings);

  [[nodiscard]] const System& stated() const { return *stated_; }
  [[nodiscard]] const Limits& limits() const { return limits_; }

 private:
  struct Contact {
    std::size_t row;
    double sign;
  };
  struct Rough {
    std::size_t row, rows, pressing_row;
    double mu, mu_static;
  };

  [[nodiscard]] Subject row(std::size_t r) const { return {Subject::Kind::row, r}; }
  void find_what_acts(const FlatSample& sample);
  void evaluate(const FlatSample& sample);
  void add_forces_that_read(const FlatSample& sample);
  [[nodiscard]] double inertia(std::size_t i) const;
  void check_newton(const FlatSample& sample, Findings& findings);
  void check_rows(const FlatSample& sample, Findings& findings) const;
  void check_row(const FlatSample& sample, std::size_t r, Findings& findings) const;
  void check_point_forces(const FlatSample& sample, Findings& findings) const;
  void check_energy(const FlatSample& sample, Findings& findings) const;
  void check_contacts(const FlatSample& sample, Findings& findings) const;
  void check_friction(const FlatSample& sample, Findings& findings) const;
  [[nodiscard]] double gradient(const FlatSample& sample, std::size_t contact) const;
  [[nodiscard]] double position_limit(std::span<const double> w, const System& of, std::size_t r,
                                      const FlatSample& sample) const;
  [[nodiscard]] double own_force(std::size_t r) const;
  [[nodiscard]] double own_uncertainty(std::size_t r, const FlatSample& sample) const;
  [[nodiscard]] double slow_slip(std::size_t r) const;
  [[nodiscard]] double velocity_limit(std::size_t r, const FlatSample& sample) const;

  std::shared_ptr<const System> stated_, acting_;
  Limits limits_;
  System::Evaluation e_;
  std::vector<double> gamma_, g_, u_;     // of rows; g and slip of conditional ones
  std::vector<double> residual_, terms_;  // of coordinates
  std::vector<std::size_t> conditional_;  // constraints
  std::vector<char> acts_, acted_;        // each of these
  std::vector<char> always_;              // each row: it is in force whatever happens
  std::vector<Contact> contacts_;
  std::vector<Rough> rough_;
  double largest_force_ = 0.0;
  double dependence_ = 0.0;  // Limits::dependent where rows repeat each other
};

}  // namespace dalembert
