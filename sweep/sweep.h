#pragma once

#include <dalembert/core/errors.h>
#include <dalembert/core/results/trajectory.h>
#include <dalembert/core/scene/scene.h>
#include <dalembert/solvers/simulation.h>
#include <dalembert/sweep/parameters.h>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <exception>
#include <functional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

namespace dalembert {

/// How to sweep.
struct SweepOptions {
  /// The dataset, HDF5; docs/sweeps.md says what is in it. Until all rows are done `<file>.journal` lies
  /// beside it: keep both, and the same program goes on where it was stopped. Needed.
  std::string file{};
  std::string title = "sweep";  ///< part of the dataset
  /// How each scene is run, unless `make` gives options of its own.
  Options run{};
  /// In each process; 0: as many as this one may use. More than 1 needs oneTBB when the library is built.
  int threads = 0;
  /// A line on the terminal, if stderr is one: rate, failures, time left.
  bool progress = true;
  /// The same, a line a minute, appended to this file; empty: none.
  std::string log{};
};

/// What became of a sweep.
struct SweepSummary {
  std::size_t rows = 0;      ///< of the table of parameters
  std::size_t done = 0;      ///< all of them, unless it was interrupted
  std::size_t failed = 0;    ///< of these the ones with an error in place of results
  std::size_t found = 0;     ///< of these the ones that an earlier call had done
  bool interrupted = false;  ///< by SIGINT or SIGTERM
  double seconds = 0.0;      ///< that this call took
  int rank = 0;              ///< of this process; the same summary is given to all
  int ranks = 1;             ///< of MPI; 1 without
  std::string file{};        ///< of the dataset

  /// One line for a reader; of an interrupted sweep it says how to go on.
  [[nodiscard]] std::string report() const;
};

/// What a run is reduced to: a number for each quantity, and rows of its series one after the other.
struct RowResult {
  std::vector<double> values{};  ///< one for each quantity
  std::vector<double> series{};  ///< one row after the other; empty if none is kept
};

/// What a row of parameters gives; see `sweep_rows`.
struct RowFunction {
  std::vector<Quantity> quantities;               ///< what it returns
  std::vector<Quantity> series{};                 ///< columns of what is kept at many times; none: nothing is
  std::function<RowResult(const Row&)> function;  ///< of a row of parameters
  /// What is done with a row, for those who find the dataset later, and to tell a sweep from others.
  std::string description{};
};

/// The general sweep: a function of a row, for what is no run of a scene, such as multipliers of Floquet or
/// equilibria. It is called by many threads at once, in any order, and gives the same for the same row.
///
/// - A row whose function throws, or gives NaN, is kept with its error and, of an IntegrationFailure, its
///   time; the sweep goes on.
/// - Rows are handed out as work is finished: over the threads of a process and, if the program was started
///   by mpirun, over its processes. The dataset does not depend on how many there are, to the last bit.
/// - Killed at any moment, the same call goes on: what the journal has is not computed again. One row is,
///   also where all are done, to see that this program still gives the same numbers.
/// - SIGINT or SIGTERM, where the program does not handle them itself: runs in progress are finished and
///   written, and the summary says `interrupted`. Another, more than a second later, ends the program.
///
/// Throws InvalidArgument for options that make no sense and columns of one name; Error for a file of another
/// sweep, one that another process is writing, a full disk: all rows that were done are safe.
SweepSummary sweep_rows(const Parameters& parameters, const RowFunction& row, const SweepOptions& options);

namespace detail {

template <class F>
struct Observation {
  std::vector<Quantity> quantities;
  std::vector<Quantity> series;
  F function;
};

[[nodiscard]] RowResult row_result(RowResult result);
[[nodiscard]] RowResult row_result(double value);
template <std::ranges::input_range Values>
[[nodiscard]] RowResult row_result(const Values& values) {
  return {{std::ranges::begin(values), std::ranges::end(values)}, {}};
}

/// What `make` built, as a scene: itself or its member `scene`.
template <class Made>
[[nodiscard]] const auto& scene_of(const Made& made) {
  if constexpr (requires { made.scene; }) {
    return made.scene;
  } else {
    return made;
  }
}

/// Options and events that `make` built with it.
template <class Made>
[[nodiscard]] const Options& options_of(const Made& made, const Options& otherwise) {
  if constexpr (requires { made.options; }) {
    return made.options;
  } else {
    return otherwise;
  }
}
template <class Made, int D>
[[nodiscard]] std::vector<Event<D>> events_of(const Made& made, const Scene<D>&) {
  if constexpr (requires { made.events; }) {
    return made.events;
  } else {
    return {};
  }
}

/// What tells this sweep from others with the same columns: the scene of the first row, and how it is run.
[[nodiscard]] std::string description(const std::string& scene, const Options& run);
[[nodiscard]] Row first_row(const Parameters& parameters, std::vector<double>& values);

template <class Make>
[[nodiscard]] std::string describe_first(const Parameters& parameters, const Make& make, const Options& run) {
  std::vector<double> values;
  try {
    const auto made = make(first_row(parameters, values));
    return description(scene_of(made).describe(), options_of(made, run));
  } catch (const std::exception& error) {
    return description(std::string("the first row has none: ") + error.what(), run);
  }
}

template <int D>
[[nodiscard]] std::vector<Quantity> trajectory_columns(const Scene<D>& scene);
template <int D>
[[nodiscard]] RowResult flattened(const Trajectory<D>& run);
extern template std::vector<Quantity> trajectory_columns(const Scene<2>&);
extern template std::vector<Quantity> trajectory_columns(const Scene<3>&);
extern template RowResult flattened(const Trajectory<2>&);
extern template RowResult flattened(const Trajectory<3>&);

}  // namespace detail

/// Reduces each run to named numbers: `function(made, run)`, of what `make` built and the Trajectory of its
/// scene, returns as many doubles as there are quantities, or one.
///
///   observing({{"tension", "N"}}, [](const Swing& it, const Trajectory<2>& run) {
///     return -run.multipliers(it.rod).minCoeff();
///   })
///
/// What never happens is infinity; NaN counts as an error of that row.
template <class F>
[[nodiscard]] detail::Observation<F> observing(std::vector<Quantity> quantities, F function) {
  return {std::move(quantities), {}, std::move(function)};
}

/// The same with a series of one's own columns at many times: `function` returns a RowResult.
template <class F>
[[nodiscard]] detail::Observation<F> observing(std::vector<Quantity> quantities, std::vector<Quantity> series,
                                               F function) {
  return {std::move(quantities), std::move(series), std::move(function)};
}

/// Keeps each trajectory at its samples: time, positions and velocities of particles and rotors, multipliers.
/// Names are those of this scene; the scenes of all rows have as many coordinates and constraints.
template <int D>
[[nodiscard]] auto keep_trajectory(const Scene<D>& like) {
  const auto keep = [](const auto&, const Trajectory<D>& run) { return detail::flattened(run); };
  return detail::Observation<decltype(keep)>{{}, detail::trajectory_columns(like), keep};
}

/// Runs a scene for each row of parameters and keeps what is observed.
///
///   struct Swing { Scene<2> scene; Constraint<1> rod; };
///   const auto make = [](const Row& row) { ... return Swing{scene, rod}; };
///   sweep(grid({{"amplitude", "rad", 0.1, 3.0, 1000}}), make, observe,
///         {.file = "swing.h5", .run = {.t_end = 10.0}});
///
/// `make(row)` returns a Scene, or a struct with a member `scene` and whatever `observe` needs, handles above
/// all; its members `options` and `events`, if there are any, are those of the run. Everything else is as
/// `sweep_rows` says.
template <class Make, class F>
SweepSummary sweep(const Parameters& parameters, const Make& make, const detail::Observation<F>& observe,
                   const SweepOptions& options) {
  const auto run_row = [&](const Row& row) {
    const auto made = make(row);
    const auto& scene = detail::scene_of(made);
    const auto run = simulate(scene, detail::options_of(made, options.run), detail::events_of(made, scene));
    return detail::row_result(observe.function(made, run));
  };
  return sweep_rows(
      parameters,
      {observe.quantities, observe.series, run_row, detail::describe_first(parameters, make, options.run)},
      options);
}

}  // namespace dalembert
