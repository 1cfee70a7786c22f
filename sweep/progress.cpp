#include "dalembert/sweep/progress.h"

#include <dalembert/core/errors.h>
#include <dalembert/sweep/interrupt.h>

#include <unistd.h>

#include <cmath>
#include <ctime>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace dalembert {

namespace {

constexpr const char* clear_line = "\r\033[K";

std::string duration(double seconds) {
  std::ostringstream out;
  const auto whole = static_cast<long>(std::ceil(seconds));
  const auto two = [&out](long number) { out << std::setfill('0') << std::setw(2) << number; };
  if (whole >= 3600) {
    out << whole / 3600 << " h ";
    two(whole / 60 % 60);
    out << " min";
  } else if (whole >= 60) {
    out << whole / 60 << " min ";
    two(whole % 60);
    out << " s";
  } else {
    out << whole << " s";
  }
  return out.str();
}

std::string now_as_text() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::ostringstream out;
  out << std::put_time(&parts, "%FT%TZ");
  return out.str();
}

}  // namespace

Progress::Progress(std::uint64_t rows, std::uint64_t done, bool terminal, const std::string& log)
    : rows_(rows), found_(done), terminal_(terminal && isatty(STDERR_FILENO) == 1) {
  if (log.empty()) return;
  log_.open(log, std::ios::app);
  if (!log_) throw Error("sweep: the log " + log + " cannot be written; does its folder exist?");
}

Progress::~Progress() {
  if (terminal_) std::cerr << clear_line << std::flush;
}

std::string Progress::line(const Book::Counts& now) const {
  std::ostringstream out;
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  const std::uint64_t new_rows = now.done - found_;
  const double rate = seconds > 0.0 ? static_cast<double>(new_rows) / seconds : 0.0;
  out << now.done << " of " << rows_ << " rows (" << 100 * now.done / rows_ << " %), " << std::setprecision(3)
      << rate << " rows/s, " << now.failed << " failed";
  if (new_rows > 0 && now.done < rows_)
    out << ", " << duration(static_cast<double>(rows_ - now.done) / rate) << " left";
  if (Interrupt::noted()) out << "; finishing what runs, once more to end at once";
  return out.str();
}

void Progress::show(const Book::Counts& now) {
  const auto time = Clock::now();
  const std::string text = line(now);
  if (terminal_) std::cerr << clear_line << text << std::flush;
  if (time - logged_ < std::chrono::minutes(1)) return;
  logged_ = time;
  log(text);
}

void Progress::log(const std::string& text) {
  if (log_.is_open()) log_ << now_as_text() << "  " << text << std::endl;
}

}  // namespace dalembert
