#pragma once

#include <dalembert/core/analysis/islands.h>
#include <dalembert/core/analysis/rank.h>
#include <dalembert/solvers/linear/saddle.h>

#include <memory>
#include <optional>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// What stays as it is while the same constraints are in force, made once and shared by the start of a run,
/// its projections, the recovery of forces and the steppers: the equations, which of them are coupled, and
/// how the matrices of each choice of rows are factored. Copies share it; for one thread.
class Problem {
 public:
  explicit Problem(System system);
  explicit Problem(std::shared_ptr<const System> system);

  [[nodiscard]] const System& system() const { return *shared_->system; }
  [[nodiscard]] const std::shared_ptr<const System>& shared_system() const { return shared_->system; }
  /// Found when first asked for.
  [[nodiscard]] const Islands& islands() const {
    if (!shared_->islands) shared_->islands = dalembert::islands(system());
    return *shared_->islands;
  }
  /// Of these rows, and all coordinates or those that they read. Analysed when first asked for, and kept
  /// until many others have been.
  [[nodiscard]] std::shared_ptr<const SaddlePattern> pattern(const std::vector<std::size_t>& rows) const;
  [[nodiscard]] std::shared_ptr<const SaddlePattern> pattern(
      const std::vector<std::size_t>& rows, const std::vector<std::size_t>& coordinates) const;
  /// For all that is kept.
  [[nodiscard]] SaddlePattern::Analyses analyses() const;

 private:
  struct Shared {
    std::shared_ptr<const System> system;
    std::vector<std::size_t> coordinates;
    std::optional<Islands> islands{};
    std::vector<std::shared_ptr<const SaddlePattern>> patterns{};  // the last asked for stands last
  };
  std::shared_ptr<Shared> shared_;
};

}  // namespace dalembert
