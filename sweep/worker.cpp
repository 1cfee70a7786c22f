#include "dalembert/sweep/worker.h"

#include <dalembert/core/errors.h>
#include <dalembert/sweep/interrupt.h>
#include <dalembert/sweep/text.h>

#include <chrono>
#include <cmath>
#include <limits>

namespace dalembert {

namespace {

/// Of a block in memory, and in a message of MPI, which counts bytes by an int.
constexpr std::size_t largest_block = std::size_t{1} << 26, largest_row = std::size_t{1} << 30;

/// Throws if the user's function gave something else than it announced.
void require_result(const RowResult& result, const RowFunction& row) {
  if (result.values.size() != row.quantities.size())
    throw InvalidArgument("observation: " + as_text(result.values.size()) + " numbers for " +
                          as_text(row.quantities.size()) + " quantities (" + as_text(row.quantities) + ")");
  for (std::size_t k = 0; k < result.values.size(); ++k)
    if (std::isnan(result.values[k]))
      throw Error("observation: \"" + row.quantities[k].name +
                  "\" is NaN; what never happens is better told by infinity");
  const std::size_t width = row.series.size();
  if (width == 0 ? !result.series.empty() : result.series.size() % width != 0)
    throw InvalidArgument("observation: a series of " + as_text(result.series.size()) + " numbers for " +
                          as_text(width) + " columns (" + as_text(row.series) + ")");
  if (result.series.size() > largest_row / sizeof(double))
    throw InvalidArgument("observation: a series of " + as_text(result.series.size()) +
                          " numbers; keep fewer samples, at most 1 GiB for each row");
}

}  // namespace

void Work::run(std::uint64_t index, Block& out) const {
  constexpr double no_time = std::numeric_limits<double>::quiet_NaN();
  try {
    std::vector<double> values(parameters.columns().size());
    parameters.fill(index, values);
    const RowResult result = row.function(Row(index, parameters.columns(), values));
    require_result(result, row);
    out.add(result.values, result.series, widths);
  } catch (const IntegrationFailure& failure) {
    out.add_failure(failure.time(), failure.what());
  } catch (const std::exception& error) {
    out.add_failure(no_time, error.what());
  } catch (...) {
    out.add_failure(no_time, "something was thrown that is no std::exception");
  }
}

Block Work::run(const Chunk& chunk) const {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  Block block{.rows = {chunk.rows.first, 0}};
  const auto goes_on = [&] {
    return block.rows.count < chunk.rows.count && !Interrupt::noted() &&
           block.seconds < 2.0 * chunk.seconds && block.bytes.size() < largest_block;
  };
  while (goes_on()) {
    run(block.rows.end(), block);
    block.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  }
  return block;
}

void work_alone(const Work& work, Source& source, int worker) noexcept {
  try {
    while (const auto chunk = source.next(worker)) source.enter(*chunk, work.run(*chunk));
  } catch (const std::exception& error) {
    source.stop(error.what());
  }
}

}  // namespace dalembert
