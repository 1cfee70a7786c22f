#pragma once

#include <dalembert/core/equations/batch.h>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace dalembert {

/// The applied forces of a scene one by one, evaluated where a sample is read: a run records none of them.
class AppliedForces {
 public:
  /// Where a force is found: in a batch, or else as the same acceleration for every particle.
  struct Place {
    std::shared_ptr<const ForceBatch> batch{};
    std::size_t element = 0;
    std::size_t first_row = 0;  ///< of the multipliers that it reads, if it does
    std::array<double, 3> acceleration{};
  };

  /// In the order of Layout::forces.
  explicit AppliedForces(std::vector<Place> places) : places_(std::move(places)) {}

  /// Of force `number`, what acts on as many coordinates from `first` on as `out` holds: those of a particle
  /// with this mass, or of a rotor with none. False if it reads a multiplier that is not determined (NaN).
  /// Throws ElementFault.
  [[nodiscard]] bool on(std::size_t number, const Instant& at, std::span<const double> lambda, int first,
                        double mass, std::span<double> out) const;
  /// Raises `to` to the largest that any one of them is on each coordinate, in size. Left out are uniform
  /// accelerations, and what reads a multiplier that is not determined. Throws ElementFault.
  void raise_to_sizes(const Instant& at, std::span<const double> lambda, std::span<double> to) const;

 private:
  /// Of a batch's force, on each of its coordinates; false as in `on`.
  static bool evaluate(const Place& place, const Instant& at, std::span<const double> lambda,
                       std::vector<double>& force);

  std::vector<Place> places_;
};

}  // namespace dalembert
