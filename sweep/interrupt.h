#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <csignal>

namespace DALEMBERT_HIDDEN dalembert {

/// While it lives, SIGINT and SIGTERM are noted instead of ending the process; another that comes more
/// than a second later ends it.
/// Those that the program handles or ignores are left to it.
class Interrupt {
 public:
  Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;
  ~Interrupt();

  /// Whether one has come since the latest Interrupt was made. By any thread.
  [[nodiscard]] static bool noted();
  /// As if one had come here: to another process of the same sweep.
  static void note();

 private:
  struct sigaction before_[2]{};
};

}  // namespace dalembert
