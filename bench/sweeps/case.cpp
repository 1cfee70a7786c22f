#include <dalembert/bench/sweeps/examples.h>
#include <dalembert/bench/sweeps/table.h>
#include <dalembert/core/errors.h>

#include <sys/resource.h>

#include <chrono>
#include <condition_variable>
#include <fstream>
#include <iostream>
#include <mutex>
#include <stop_token>
#include <thread>

namespace dalembert::bench {

namespace {

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // Linux counts in KiB
}

Example example_of(const std::string& name, std::size_t rows, std::size_t bad) {
  if (name == "pendulums") return pendulums(rows, bad);
  if (name == "flips") return flips(rows);
  if (name == "kapitza") return kapitza(rows);
  if (name == "kapitza-boundary") return kapitza_boundary(rows);
  if (name == "governors") return governors(rows, 1);
  throw Error("no sweep is called " + name);
}

/// The loop that a user would write: one run after the other, the results into a file at the end.
double bare(const Example& example, const std::string& file) {
  const auto start = std::chrono::steady_clock::now();
  const Parameters& parameters = example.parameters;
  std::vector<double> values(parameters.columns().size()), results;
  for (std::size_t i = 0; i < parameters.rows(); ++i) {
    parameters.fill(i, values);
    const RowResult row = example.row.function(Row(i, parameters.columns(), values));
    results.insert(results.end(), row.values.begin(), row.values.end());
  }
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(results.data()),
            static_cast<std::streamsize>(results.size() * sizeof(double)));
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void sweep_case(const std::string& name, std::size_t rows, int threads, std::size_t bad,
                const std::string& file) {
  const Example example = example_of(name, rows, bad);
  if (threads <= 0) {
    // It only has to be there: glibc's allocator takes locks from then on.
    const std::jthread idle = threads < 0 ? std::jthread([](const std::stop_token& over) {
      std::mutex mutex;
      std::unique_lock lock(mutex);
      std::condition_variable_any().wait(lock, over, [] { return false; });
    })
                                          : std::jthread();
    const double seconds = bare(example, file);
    std::cout << seconds << " 0 " << peak_memory() << '\n';
    return;
  }
  const SweepSummary summary =
      sweep_rows(example.parameters, example.row, {.file = file, .title = name, .threads = threads});
  if (summary.rank == 0)
    std::cout << summary.seconds << ' ' << summary.failed << ' ' << peak_memory() << '\n';
}

}  // namespace dalembert::bench
