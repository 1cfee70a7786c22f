#pragma once

#include <dalembert/core/results/sample.h>

#include <functional>
#include <string>
#include <vector>

namespace dalembert {

struct Record;

/// One number of every sample of a run, as tables of runs have it.
struct Column {
  std::string name;  ///< "t", "bob.x", "rod.lambda", "rod.on.bob.Zx"
  std::string
      dimension;  ///< "time", "length", "length/time", "angle", "force", ..., in the scene's own units
  std::function<double(const FlatSample&)> read;  ///< the number of this column at a sample
};

/// Those of a run: t; position and velocity of each particle, angle and rate of each rotor; multipliers of
/// each constraint, whether they are unique (1 or 0; where constraints are redundant), and its force on
/// each coordinate it acts on; energy. They refer to the record.
[[nodiscard]] std::vector<Column> columns(const Record& record);

}  // namespace dalembert
