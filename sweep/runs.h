#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dalembert {

/// A column of parameters or results of a sweep's dataset, row by row; NaN where a row failed or is not done.
/// Throws Error if there is no such file or column.
[[nodiscard]] std::vector<double> read_column(const std::string& file, const std::string& name);

/// A row of parameters whose run failed.
struct FailedRow {
  std::int64_t row;   ///< from 0
  double time;        ///< the last that the run reached; NaN if it did not begin, or the error has no time
  std::string error;  ///< its message
};
/// All that failed, in the order of rows. Throws Error if there is no such file.
[[nodiscard]] std::vector<FailedRow> read_failures(const std::string& file);

/// What a sweep is, as its dataset says it: title, parameters, seed, results, series, scene, library or
/// compiler.
[[nodiscard]] std::string read_about(const std::string& file, const std::string& what);

}  // namespace dalembert
