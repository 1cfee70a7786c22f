#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/sweep/book.h>

#include <chrono>
#include <fstream>
#include <string>

namespace DALEMBERT_HIDDEN dalembert {

/// Rate, failures and time left: a line on a terminal, redrawn, and a line a minute in a log.
class Progress {
 public:
  /// `done`: rows that were there. Throws Error if the log cannot be written.
  Progress(std::uint64_t rows, std::uint64_t done, bool terminal, const std::string& log);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();  ///< clears the line

  void show(const Book::Counts& now);
  /// As the last line of the log.
  void log(const std::string& line);
  [[nodiscard]] std::string line(const Book::Counts& now) const;

 private:
  using Clock = std::chrono::steady_clock;
  std::uint64_t rows_, found_;
  bool terminal_;
  std::ofstream log_;
  Clock::time_point start_ = Clock::now(), logged_ = start_;
};

}  // namespace dalembert
