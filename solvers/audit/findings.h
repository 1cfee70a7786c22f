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

  /// What is NaN is not determined, and no case.
  void weigh(Law law, const Subject& subject, double time, double size, double limit) {
    Case& worst = worst_[static_cast<std::size_t>(law)];
    if (!(size * worst.limit > worst.size * limit)) return;
    worst = {subject, time, size, limit};
  }
  /// Adds those of others.
  void add(const Findings& others);
  /// The law that is violated most, if any is.
  [[nodiscard]] const Case* violated(Law& law) const;
  [[nodiscard]] Audit read(const System& system) const;

 private:
  std::array<Case, number_of_laws> worst_{};
};

}  // namespace dalembert
