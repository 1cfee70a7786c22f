#include "dalembert/bench/sweeps/table.h"

#include <dalembert/bench/median.h>
#include <dalembert/bench/progress.h>
#include <dalembert/bench/sweeps/child.h>
#include <dalembert/bench/sweeps/examples.h>
#include <dalembert/bench/table.h>
#include <dalembert/sweep/runs.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>
#include <thread>

namespace dalembert::bench {

namespace {

using Clock = std::chrono::steady_clock;

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A folder for datasets, gone afterwards.
class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() / ("dalembert-sweeps-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path_); }
  [[nodiscard]] std::string operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

struct Case {
  std::string name, example;
  std::size_t rows;
  int threads, ranks;  ///< 0 threads: the bare loop, -1: beside an idle thread; 0 ranks: without mpirun
  std::size_t bad = 0;
  Allocator allocator = Allocator::glibc;

  [[nodiscard]] std::vector<std::string> arguments(const std::string& file) const {
    return {"case",      example,
            "--rows",    std::to_string(rows),
            "--threads", std::to_string(threads),
            "--bad",     std::to_string(bad),
            "--file",    file};
  }
  [[nodiscard]] int workers() const { return std::max(1, threads) * std::max(1, ranks); }
};

struct Measured {
  double seconds = 0.0;
  std::size_t failed = 0;
  double memory = 0.0;  ///< [MiB]
};

Measured run(const Case& one, const std::string& file) {
  Child child(one.arguments(file), one.ranks, Errors::shown, one.allocator);
  if (!child.wait()) throw Error("sweep: the case " + one.name + " failed");
  Measured measured;
  std::istringstream(child.output()) >> measured.seconds >> measured.failed >> measured.memory;
  return measured;
}

void remove(const std::string& file) {
  for (const char* end : {"", ".journal", ".new"}) std::filesystem::remove(file + end);
}

/// Until no process has the journal open any more: what mpirun leaves behind ends a little later.
void wait_for(const std::string& journal) {
  const int file = open(journal.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return;
  flock(file, LOCK_EX);
  close(file);
}

class Report {
 public:
  explicit Report(const SweepTable& options) : options_(options) {}

  void add(const Case& one, const Measured& measured, double efficiency, bool identical) {
    const std::size_t runs =
        one.example == "flips" || one.example == "kapitza" ? one.rows * one.rows : one.rows;
    const std::string rows = std::to_string(runs);
    table_.rows.push_back({one.name, rows, std::to_string(std::max(1, one.threads)),
                           std::to_string(std::max(1, one.ranks)), scientific(measured.seconds),
                           scientific(static_cast<double>(runs) / measured.seconds),
                           std::isnan(efficiency) ? "" : scientific(efficiency, 3),
                           std::to_string(measured.failed), identical ? "yes" : "no"});
    memory_.rows.push_back({one.name, rows, scientific(measured.memory, 3)});
    if (identical) return;
    ++wrong_;
    std::cerr << "sweep: " << one.name << " gave another dataset\n";
  }
  void expect(bool good, const std::string& what) {
    if (good) return;
    ++wrong_;
    std::cerr << "sweep: " << what << '\n';
  }
  [[nodiscard]] int finish() const {
    report("Sweeps: many scenes over threads and ranks, killed and gone on with", table_, options_.report);
    memory_.print(std::cout << "\npeak memory of the first process [MiB]\n");
    if (!options_.report.csv.empty()) {
      std::filesystem::path path = options_.report.csv;
      std::ofstream file(path.replace_filename(path.stem().string() + "-memory.csv"));
      memory_.write_csv(file);
    }
    return wrong_;
  }

 private:
  const SweepTable& options_;
  Table table_{.columns = {"case", "runs", "threads", "ranks", "run_time_s", "runs_per_s", "efficiency",
                           "failed", "identical"},
               .rows = {}};
  Table memory_{.columns = {"case", "runs", "peak_mib"}, .rows = {}};
  int wrong_ = 0;
};

/// Whether the dataset has the numbers of the bare loop, a row's results one after the other.
bool same_numbers(const std::string& dataset, const std::string& bare) {
  const auto tension = read_column(dataset, "tension"), x = read_column(dataset, "x");
  std::string numbers;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double row[] = {tension[i], x[i]};
    numbers.append(reinterpret_cast<const char*>(row), sizeof row);
  }
  return numbers == bytes_of(bare);
}

/// The timed cases in turn, round after round; each is compared with the bare loop of its own round that has
/// the same allocator.
void timed(const SweepTable& options, const Folder& folder, Report& report) {
  std::vector<Case> cases;
  std::vector<std::size_t> loop;
  for (const Allocator allocator : {Allocator::glibc, Allocator::mimalloc}) {
    if (!has(allocator)) continue;
    const std::size_t first = cases.size();
    const auto add = [&](const std::string& name, int threads, int ranks) {
      const std::string with = allocator == Allocator::mimalloc ? "-mimalloc" : "";
      cases.push_back({name + with, "pendulums", options.rows, threads, ranks, 0, allocator});
      loop.push_back(first);
    };
    add("bare-loop", 0, 0);
    add("beside-an-idle-thread", -1, 0);
    add("1-thread", 1, 0);
    add("2-threads", 2, 0);
    if (has_mpirun()) add("2-ranks", 1, 2);
  }
  constexpr std::size_t first_sweep = 2;
  std::vector<std::vector<double>> seconds(cases.size()), efficiency(cases.size());
  std::vector<Measured> last(cases.size());
  std::vector<char> same(cases.size(), 1);
  Progress progress(cases.size() * static_cast<std::size_t>(options.rounds));
  for (int round = 0; round < options.rounds; ++round) {
    for (std::size_t i = 0; i < cases.size(); ++i) {
      progress.next(cases[i].name);
      const bool is_sweep = cases[i].threads > 0;
      const std::string file = folder / (!is_sweep ? "bare" : i == first_sweep ? "whole.h5" : "timed.h5");
      remove(file);
      last[i] = run(cases[i], file);
      seconds[i].push_back(last[i].seconds);
      efficiency[i].push_back(seconds[loop[i]].back() / (last[i].seconds * cases[i].workers()));
      if (is_sweep)
        same[i] = same[i] != 0 && same_numbers(file, folder / "bare") &&
                  bytes_of(file) == bytes_of(folder / "whole.h5");
    }
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    last[i].seconds = median(seconds[i]);
    report.add(cases[i], last[i], median(efficiency[i]), same[i] != 0);
  }
}

/// A hundredth of the runs fails: each is a row with its error, and the others are as they were.
void failing(const SweepTable& options, const Folder& folder, Report& report) {
  constexpr std::size_t bad = 100;
  const Case one{"1-in-100-fails", "pendulums", options.rows, 2, 0, bad};
  const std::string file = folder / "failing.h5";
  remove(file);
  const Measured measured = run(one, file);
  const auto all = read_column(folder / "whole.h5", "tension"), left = read_column(file, "tension");
  const auto failures = read_failures(file);
  bool good = failures.size() == options.rows / bad && measured.failed == failures.size();
  for (std::size_t i = 0; i < all.size(); ++i)
    good = good && (i % bad == bad - 1 ? std::isnan(left[i]) : left[i] == all[i]);
  for (std::size_t k = 0; good && k < failures.size(); ++k)
    good = failures[k].row == static_cast<std::int64_t>(bad * k + bad - 1) &&
           failures[k].error.find("a gale") != std::string::npos && failures[k].time > 0.0 &&
           failures[k].time <= 0.5;
  report.add(one, measured, std::nan(""), good);
}

/// Killed so many times, at random times, and each time gone on with by the same command.
void killed(const SweepTable& options, const Folder& folder, double whole_seconds, Report& report) {
  std::vector<Case> cases{{"killed", "pendulums", options.rows, 2, 0}};
  if (has_mpirun()) {
    cases.push_back({"rank-killed", "pendulums", options.rows, 1, 2});
    cases.push_back({"all-ranks-killed", "pendulums", options.rows, 1, 2});
  }
  std::mt19937_64 random(37);
  // From its start, when files are made, to what is some tenths of its rows later.
  std::uniform_real_distribution<double> after(0.0, 0.2 + whole_seconds / options.kills);
  for (const Case& one : cases) {
    const std::string file = folder / "killed.h5";
    remove(file);
    const auto start = Clock::now();
    for (int kill = 0; kill < options.kills; ++kill) {
      Child child(one.arguments(file), one.ranks, Errors::hidden);
      std::this_thread::sleep_for(std::chrono::duration<double>(after(random)));
      one.name == "rank-killed" ? child.kill_one(random()) : child.kill_all();
      constexpr int patience = 10'000;
      const bool finished = child.wait(patience);
      wait_for(file + ".journal");
      if (std::filesystem::exists(file))
        report.expect(read_column(file, "x").size() == options.rows, "a dataset is not whole");
      // Done before it was killed: once more from the beginning.
      if (finished) remove(file);
    }
    Measured measured = run(one, file);
    measured.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    report.add(one, measured, std::nan(""), bytes_of(file) == bytes_of(folder / "whole.h5"));
  }
}

/// Some rows computed alone have the bits of the dataset.
bool alone_the_same(const Example& example, const std::string& file) {
  const Parameters& parameters = example.parameters;
  const auto column = read_column(file, example.row.quantities.front().name);
  std::vector<double> values(parameters.columns().size());
  for (std::size_t i = 0; i < 50; ++i) {
    const std::size_t row = i * (parameters.rows() - 1) / 49;
    parameters.fill(row, values);
    if (example.row.function(Row(row, parameters.columns(), values)).values.front() != column[row])
      return false;
  }
  return true;
}

/// For gnuplot: numbers of 4 bytes in the order of rows.
void write_floats(const std::string& path, const std::vector<double>& column) {
  const std::vector<float> floats(column.begin(), column.end());
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(floats.data()),
             static_cast<std::streamsize>(floats.size() * sizeof(float)));
  if (!file.flush()) throw Error(path + " could not be written");
}

void write(const std::string& path, const Table& table) {
  std::ofstream file(path);
  table.write_csv(file);
  if (!file.flush()) throw Error(path + " could not be written");
}

std::string picture(const SweepTable& options, const std::string& name, const std::string& example,
                    std::size_t rows, const Example& same, const Folder& folder, Report& report) {
  const Case one{name, example, rows, 2, 0};
  const std::string file = folder / (name + ".h5");
  const Measured measured = run(one, file);
  report.add(one, measured, std::nan(""), alone_the_same(same, file));
  std::cout << options.directory << '/' << name << ": " << read_failures(file).size() << " failed\n";
  return file;
}

void draw_flips(const SweepTable& options, const Folder& folder, Report& report) {
  const std::string file =
      picture(options, "flips", "flips", options.flips, flips(options.flips), folder, report);
  const auto flip = read_column(file, "flip"), one = read_column(file, "angle1"),
             two = read_column(file, "angle2");
  // What energy forbids, and what a mirror shows: (-a, -b) flips when (a, b) does, up to chaos.
  for (std::size_t i = 0; i < flip.size(); ++i)
    report.expect(!(3.0 * std::cos(one[i]) + std::cos(two[i]) > 2.0 && std::isfinite(flip[i])),
                  "a double pendulum flipped that has not the energy");
  write_floats(options.directory + "/flips.bin", flip);
}

void draw_kapitza(const SweepTable& options, const Folder& folder, Report& report) {
  const std::string file =
      picture(options, "kapitza-runs", "kapitza", options.kapitza, kapitza(options.kapitza), folder, report);
  write_floats(options.directory + "/kapitza-runs.bin", read_column(file, "gone"));
  const std::size_t points = std::min<std::size_t>(options.kapitza, 100);
  const std::string boundary = picture(options, "kapitza-floquet", "kapitza-boundary", points,
                                       kapitza_boundary(points), folder, report);
  Table table{.columns = {"amplitude", "lower", "upper"}, .rows = {}};
  const auto A = read_column(boundary, "amplitude"), lower = read_column(boundary, "lower"),
             upper = read_column(boundary, "upper");
  for (std::size_t i = 0; i < A.size(); ++i)
    if (lower[i] >= 0.0)
      table.rows.push_back({scientific(A[i], 8), scientific(lower[i], 8), scientific(upper[i], 8)});
  write(options.directory + "/kapitza-floquet.csv", table);
}

/// The 99 % quantile is the order statistic of that rank. Ranks that hold it in 95 % of all samples are 1.96
/// standard deviations of the binomial distribution off, whatever that of the force (David, Nagaraja 2003).
void draw_governors(const SweepTable& options, const Folder& folder, Report& report) {
  const std::string file = picture(options, "governors", "governors", options.governors,
                                   governors(options.governors, 1), folder, report);
  auto force = read_column(file, "bearing");
  std::ranges::sort(force);
  const auto count = static_cast<double>(force.size());
  const double rank = 0.99 * count, off = 1.96 * std::sqrt(count * 0.99 * 0.01);
  const auto at = [&](double r) {
    return force[static_cast<std::size_t>(std::clamp(std::ceil(r) - 1.0, 0.0, count - 1.0))];
  };
  Table table{.columns = {"quantile", "force", "lower", "upper"},
              .rows = {{"0.99", scientific(at(rank), 8), scientific(at(rank - off), 8),
                        scientific(at(rank + off), 8)}}};
  write(options.directory + "/governors-quantile.csv", table);
  std::cout << "bearing force of the governors, 99 % quantile: " << at(rank) << " N, 95 % interval "
            << at(rank - off) << " to " << at(rank + off) << " N\n";
  Table all{.columns = {"force"}, .rows = {}};
  for (const double f : force) all.rows.push_back({scientific(f, 8)});
  write(options.directory + "/governors.csv", all);
}

}  // namespace

int sweep_table(const SweepTable& options) {
  require_writable(options.report);
  const Folder folder;
  Report report(options);
  timed(options, folder, report);
  failing(options, folder, report);
  // Memory against rows: a tenth of them.
  const Case tenth{"1-thread-a-tenth", "pendulums", options.rows / 10, 1, 0};
  const Measured measured = run(tenth, folder / "tenth.h5");
  report.add(tenth, measured, std::nan(""), alone_the_same(pendulums(tenth.rows, 0), folder / "tenth.h5"));
  const Case once_more{"1-thread", "pendulums", options.rows, 1, 0};
  killed(options, folder, run(once_more, folder / "again.h5").seconds / 2.0, report);
  draw_governors(options, folder, report);
  draw_kapitza(options, folder, report);
  draw_flips(options, folder, report);
  return report.finish();
}

}  // namespace dalembert::bench
