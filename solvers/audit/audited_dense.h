#pragma once

#include <dalembert/core/results/trajectory.h>
#include <dalembert/solvers/audit/limits.h>

#include <memory>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// What a scene stated from a time on.
struct Stated {
  double from;
  std::shared_ptr<const System> system;
};

/// Dense output that is held against the laws of each instant as it is read.
class AuditedDense final : public DenseOutput {
 public:
  AuditedDense(std::shared_ptr<const DenseOutput> run, std::vector<Stated> stated, const Claim& claim);

  /// Throws EquationFault, too, where a law is broken.
  void read(std::span<const double> times, Record& out) const override;

 private:
  std::shared_ptr<const DenseOutput> run_;
  std::vector<Stated> stated_;
  Claim claim_;
};

}  // namespace dalembert
