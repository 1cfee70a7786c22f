#include "dalembert/sweep/interrupt.h"

#include <atomic>
#include <cstddef>
#include <iterator>

namespace dalembert {

namespace {

constexpr int signals[] = {SIGINT, SIGTERM};
/// Static, as a handler is told nothing but the signal.
std::atomic<bool> signal_noted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void on_signal(int) { signal_noted = true; }

}  // namespace

Interrupt::Interrupt() {
  signal_noted = false;
  for (std::size_t i = 0; i < std::size(signals); ++i) {
    sigaction(signals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_DFL || (before_[i].sa_flags & SA_SIGINFO) != 0) continue;
    struct sigaction ours {};
    ours.sa_handler = on_signal;
    ours.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    sigemptyset(&ours.sa_mask);
    sigaction(signals[i], &ours, nullptr);
  }
}

Interrupt::~Interrupt() {
  for (std::size_t i = 0; i < std::size(signals); ++i) sigaction(signals[i], &before_[i], nullptr);
}

bool Interrupt::noted() { return signal_noted; }

void Interrupt::note() { signal_noted = true; }

}  // namespace dalembert
