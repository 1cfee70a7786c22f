#include "dalembert/sweep/interrupt.h"

#include <atomic>
#include <cstddef>
#include <ctime>
#include <iterator>

namespace dalembert {

namespace {

constexpr int signals[] = {SIGINT, SIGTERM};
/// Static, as a handler is told nothing but the signal.
std::atomic<bool> signal_noted = false;
std::atomic<std::time_t> noted_at = 0;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::time_t>::is_always_lock_free);

std::time_t seconds() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);  // as a handler may
  return now.tv_sec;
}

void take_note() {
  noted_at = seconds();
  signal_noted = true;
}

/// Launchers send a signal to a process and to its group, or to all ranks: what comes at once is one.
void on_signal(int signal) {
  if (!signal_noted) return take_note();
  if (seconds() - noted_at <= 1) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

Interrupt::Interrupt() {
  signal_noted = false;
  for (std::size_t i = 0; i < std::size(signals); ++i) {
    sigaction(signals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_DFL || (before_[i].sa_flags & SA_SIGINFO) != 0) continue;
    struct sigaction ours {};
    ours.sa_handler = on_signal;
    ours.sa_flags = SA_RESTART;
    sigemptyset(&ours.sa_mask);
    sigaction(signals[i], &ours, nullptr);
  }
}

Interrupt::~Interrupt() {
  for (std::size_t i = 0; i < std::size(signals); ++i) sigaction(signals[i], &before_[i], nullptr);
}

bool Interrupt::noted() { return signal_noted; }

void Interrupt::note() {
  if (!signal_noted) take_note();
}

}  // namespace dalembert
