#pragma once

#include <dalembert/core/equations/batch.h>
#include <dalembert/core/places.h>

#include <memory>
#include <span>
#include <vector>

namespace dalembert {

/// A constraint of Coulomb's law that slides.
struct Sliding {
  std::size_t element;             ///< among those of its type
  int pressed_by;                  ///< the scene's number of the constraint that gives the normal force
  double strength;                 ///< mu, with the sign of lambda
  std::vector<double> direction;   ///< of one slip velocity: +-1, which holds; of two: where sliding begins
  double slow = 0.0;               ///< below about this speed two slip velocities have that direction
  Places rows{0, 0}, slots{0, 0};  ///< where its numbers stand in the layout
};

/// What constraints of one type exert while they slide. With u the slip velocities and W = du/dv
///
///   sigma = -mu |lambda| d,   F = W^T sigma,   d = (u + s d0)/|u + s d0|     (one u: d = d0 = +-1)       (1)
///
/// where d0 is the direction and s the slowness of `Sliding`: s is below the accuracy of velocities, so that
/// d is the direction of sliding, and defined where sliding begins.
class SlidingFriction final : public ForceBatch {
 public:
  SlidingFriction(std::shared_ptr<const ConstraintBatch> of, std::vector<Sliding> sliding);

  [[nodiscard]] std::unique_ptr<ForceBatch> clone() const override;
  [[nodiscard]] ForceShape shape() const override;
  [[nodiscard]] std::size_t size() const override { return sliding_.size(); }
  [[nodiscard]] std::span<const int> coordinates() const override { return coordinates_; }
  [[nodiscard]] std::span<const int> constraints() const override { return pressed_by_; }

  void add_force(const Instant& at, const Multipliers& lambda, std::span<double> F) const override;
  void slope(const Instant& at, const Multipliers& lambda, std::span<double> out) const override;
  void linearise(const Instant& at, const Multipliers& lambda, std::span<double> stiffness,
                 std::span<double> damping) const override;
  void power(const Instant& at, const Multipliers& lambda, std::span<double> out) const override;
  void force(std::size_t element, const Instant& at, std::span<const double> lambda,
             std::span<double> out) const override;

  /// What all exert, each by the multiplier at its `first_row`: sigma, one number per equation, in its rows
  /// of lambda, and its force on each coordinate in its slots.
  void exert(const Instant& at, std::span<const std::size_t> first_row, std::span<double> lambda,
             std::span<double> slots) const;

 private:
  struct Room;
  struct Work;
  void evaluate(const Instant& at, Work& work) const;
  /// d of (1), and per unit of lambda the force along it.
  void find_direction(std::size_t i, Work& work) const;
  void find_force_per_lambda(std::size_t i, Work& work) const;

  std::shared_ptr<const ConstraintBatch> batch_;
  std::vector<char> not_sliding_;  // per row of it
  std::vector<Sliding> sliding_;
  std::vector<int> coordinates_, pressed_by_;
  std::size_t rows_, width_;
};

}  // namespace dalembert
