#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <ctime>

namespace DALEMBERT_HIDDEN dalembert {

/// Processor time of this thread [s]: what a busy machine does meanwhile does not count.
[[nodiscard]] inline double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Reading the clock takes as long as a step of a small scene: not to be read at every sample.
class Stopwatch {
 public:
  /// Switches it on or off for as long as this lives.
  class While {
   public:
    While(Stopwatch& watch, bool runs) : watch_(watch), before_(watch.runs_) { watch_.set(runs); }
    While(const While&) = delete;
    While& operator=(const While&) = delete;
    ~While() { watch_.set(before_); }

   private:
    Stopwatch& watch_;
    bool before_;
  };

  [[nodiscard]] double read() const { return runs_ ? total_ + (processor_time() - since_) : total_; }

 private:
  void set(bool runs) {
    const double now = processor_time();
    if (runs_) total_ += now - since_;
    since_ = now;
    runs_ = runs;
  }

  double total_ = 0.0, since_ = 0.0;
  bool runs_ = false;
};

}  // namespace dalembert
