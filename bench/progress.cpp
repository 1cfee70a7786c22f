#include "dalembert/bench/progress.h"

#include <unistd.h>

#include <iostream>

namespace dalembert::bench {

namespace {
constexpr const char* clear_line = "\r\033[K";
}

Progress::Progress(std::size_t count) : count_(count), terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (terminal_) std::cerr << clear_line << std::flush;
}

void Progress::next(const std::string& what) {
  ++done_;
  if (terminal_) std::cerr << clear_line << '[' << done_ << '/' << count_ << "] " << what << std::flush;
}

Outcome attempt(const std::string& what, const std::function<void()>& run) try {
  run();
  return {};
} catch (const Error& error) {
  const Outcome refused = outcome_of(error);
  tell(what, refused);
  return refused;
}

void tell(const std::string& what, const Outcome& outcome) {
  std::cerr << what << ": " << outcome.message << '\n';
}

}  // namespace dalembert::bench
