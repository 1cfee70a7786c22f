#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/view/columns.h>
#include <dalembert/view/instants.h>

#include <functional>
#include <optional>
#include <span>

namespace DALEMBERT_HIDDEN dalembert {

/// The columns of a page, read from the instants that it shows, and their errors.
class Quantities {
 public:
  /// What can be read of an instant: so many numbers.
  using Reading = std::function<void(const FlatSample& at, std::span<double> out)>;

  Quantities(std::vector<Shown> shown, const TwoRuns* certified);

  [[nodiscard]] const std::vector<Shown>& shown() const { return shown_; }
  [[nodiscard]] Columns& columns() { return columns_; }

  /// A column for each number; their numbers.
  std::vector<std::size_t> add(int numbers, const Reading& read);
  /// The error of all of them as one vector, by its norm; infinite where it is not known. None if the run is
  /// not certified.
  enum class Kind { position, velocity, angle, angular_velocity, force, other };
  std::optional<std::size_t> add_error(int numbers, Kind kind, const Reading& read);

 private:
  [[nodiscard]] double error(const Shown& at, int numbers, Kind kind, const Reading& read) const;
  [[nodiscard]] double floor_of(Kind kind, const Certainty& its) const;

  std::vector<Shown> shown_;
  const TwoRuns* certified_;
  Columns columns_;
};

}  // namespace dalembert
