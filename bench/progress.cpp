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

}  // namespace dalembert::bench
