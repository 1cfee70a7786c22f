#pragma once

#include <dalembert/core/results/audit.h>
#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>

#include <array>
#include <string>

namespace DALEMBERT_HIDDEN dalembert {

/// What a law is about: labels are made only where they are read.
struct Subject {
  enum class Kind { row, coordinate, scene } kind = Kind::scene;
  std::size_t index = 0;

  [[nodiscard]] std::string label(const System& system) const;
};

/// Of every law the case that is worst, by its size over the limit.
class Findings {
 public:
  struct Case {
    Subject subject{};
    double time = 0.0, size = -1.0, limit = 1.0;  ///< a size below 0: the law has applied to nothing yet
  };

  /// What follows is only looked at for violations, which count once it is done again with the limits of what
  /// the run has reached; or they count.
  void look() { counts_ = violated_ = false; }
  void count() {
    counts_ = true;
    violated_ = false;
  }
  /// Whether there has been any since then, and the worst of those that count.
  [[nodiscard]] bool violated() const { return violated_; }
  [[nodiscard]] const Case& violation() const { return violation_; }

  /// What is NaN is not determined, and no case.
  void weigh(Law law, const Subject& subject, double time, double size, double limit) {
    Case& worst = worst_[static_cast<std::size_t>(law)];
    if (!(size * worst.limit > worst.size * limit)) return;
    if (size > limit && !counts_) {
      violated_ = true;
      return;
    }
    worst = {subject, time, size, limit};
    if (size > limit) add_violation(law, worst);
  }
  [[nodiscard]] Audit read(const System& system) const;
  /// What to say of that violation.
  [[nodiscard]] std::string message(const System& system) const;

 private:
  void add_violation(Law law, const Case& one);

  std::array<Case, number_of_laws> worst_{};
  bool counts_ = true, violated_ = false;
  Law law_{};
  Case violation_{};
};

}  // namespace dalembert
