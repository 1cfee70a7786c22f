#pragma once

#include <dalembert/core/equations/batch.h>

namespace dalembert {

/// A type of forces that have a potential: the equation V(t, r).
struct PotentialType {
  detail::EquationType energy;
  ForceShape shape;
};

/// Forces of one type that have a potential: F = -V_r, dF/dq = -V_rr.
class PotentialBatch final : public ForceBatch {
 public:
  explicit PotentialBatch(const PotentialType& type) : type_(&type), energies_(type.energy) {}

  [[nodiscard]] bool holds(const std::type_info& type) const {
    return *energies_.elements().type().type == type;
  }
  void add(const void* force) { energies_.elements().add(force); }
  void replace(std::size_t i, const void* force) { energies_.elements().replace(i, force); }

  [[nodiscard]] std::unique_ptr<ForceBatch> clone() const override;
  [[nodiscard]] ForceShape shape() const override { return type_->shape; }
  [[nodiscard]] std::size_t size() const override { return energies_.elements().size(); }
  [[nodiscard]] std::span<const int> coordinates() const override {
    return energies_.elements().coordinates();
  }

  void add_force(const Instant& at, const Multipliers& lambda, std::span<double> F) const override;
  void power(const Instant& at, const Multipliers& lambda, std::span<double> out) const override;
  void linearise(const Instant& at, const Multipliers& lambda, std::span<double> stiffness,
                 std::span<double> damping) const override;
  void force(std::size_t element, const Instant& at, std::span<const double> lambda,
             std::span<double> out) const override;
  [[nodiscard]] double energy(const Instant& at) const override;

 private:
  const PotentialType* type_;
  detail::DifferentiatedEquations energies_;
};

}  // namespace dalembert
