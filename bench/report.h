#pragma once

#include <dalembert/bench/table.h>

#include <string>

namespace dalembert::bench {

/// What every result is reported with.
struct ReportOptions {
  std::string csv;   ///< file for the table as comma-separated values; none if empty
  std::string note;  ///< a line for the heading, such as the commit
};

/// Prints a table to stdout below a heading: what it answers, machine, compiler, flags, versions, the note.
/// If a CSV file is asked for, writes it, and the heading and table beside it with the extension .txt. Throws
/// Error if a file cannot be written.
void report(const std::string& question, const Table& table, const ReportOptions& options);

/// Throws Error if `options.csv` cannot be written: better before a long run than after it.
void require_writable(const ReportOptions& options);

}  // namespace dalembert::bench
