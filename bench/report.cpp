#include "dalembert/bench/report.h"

#include <dalembert/bench/sundials.h>
#include <dalembert/core/errors.h>

#include <Eigen/Core>
#include <SuiteSparse_config.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <thread>

namespace dalembert::bench {

namespace {

/// The processor's name as Linux tells it.
std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t begin = line.find_first_not_of(" \t", line.find(':') + 1);
    if (begin != std::string::npos) return line.substr(begin);
  }
  return "unknown processor";
}

void print(std::ostream& out, const std::string& question, const Table& table, const std::string& note) {
  out << "# " << question << '\n'
      << "# " << processor() << ", " << std::thread::hardware_concurrency() << " threads\n"
      << "# " << BENCH_COMPILER << ", " << BENCH_BUILD_TYPE << ": " << BENCH_CXX_FLAGS << '\n'
      << "# Eigen " << EIGEN_WORLD_VERSION << '.' << EIGEN_MAJOR_VERSION << '.' << EIGEN_MINOR_VERSION
      << ", SuiteSparse " << SUITESPARSE_MAIN_VERSION << '.' << SUITESPARSE_SUB_VERSION << '.'
      << SUITESPARSE_SUBSUB_VERSION << '\n'
      << "# " << sundials() << '\n';
  if (!note.empty()) out << "# " << note << '\n';
  out << '\n';
  table.print(out);
}

std::ofstream open(const std::filesystem::path& path, std::ios::openmode mode) {
  std::ofstream file(path, mode);
  if (!file) throw Error("cannot write " + path.string() + ": does its folder exist?");
  return file;
}

}  // namespace

void report(const std::string& question, const Table& table, const ReportOptions& options) {
  print(std::cout, question, table, options.note);
  if (options.csv.empty()) return;
  std::ofstream csv = open(options.csv, std::ios::trunc);
  table.write_csv(csv);
  std::ofstream text = open(std::filesystem::path(options.csv).replace_extension(".txt"), std::ios::trunc);
  print(text, question, table, options.note);
}

void require_writable(const ReportOptions& options) {
  if (options.csv.empty()) return;
  if (std::filesystem::path(options.csv).extension() == ".txt")
    throw Error("--csv " + options.csv + ": the extension .txt is taken by the table for readers; use .csv");
  open(options.csv, std::ios::app);
}

}  // namespace dalembert::bench
