#pragma once

#include <dalembert/tests/outcome.h>

#include <functional>
#include <string>

namespace dalembert::bench {

/// One line on stderr that says what is being done; nothing if stderr is not a terminal.
class Progress {
 public:
  explicit Progress(std::size_t count);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();  ///< clears the line

  /// The next of `count` pieces of work begins.
  void next(const std::string& what);

 private:
  std::size_t count_, done_ = 0;
  bool terminal_;
};

/// Runs it. Why `what` was refused is told at the terminal: a row of its table like any other, no failure of
/// the benchmark.
Outcome attempt(const std::string& what, const std::function<void()>& run);
void tell(const std::string& what, const Outcome& outcome);

}  // namespace dalembert::bench
