#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <functional>
#include <optional>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The polynomial through a function's values at the Chebyshev nodes of an interval, in its barycentric form
/// (Berrut, Trefethen, SIAM Review 46 (2004) 501).
struct Interpolant {
  std::vector<double> nodes, values;

  [[nodiscard]] double operator()(double t) const;
  [[nodiscard]] double slope(std::size_t node) const;
  /// Where between a and b it is closest to 0, or beyond it, seen from the side of `side`; by golden-section
  /// search.
  [[nodiscard]] double turn(double a, double b, int side) const;
  [[nodiscard]] int degree() const { return static_cast<int>(nodes.size()) - 1; }
};

/// Of the interpolant of a function that may be faster than a step's polynomial: of fewer values, some are
/// alike by chance at a period, or a multiple.
inline constexpr int least_degree = 6;

/// A function of time that fails by itself where it cannot be evaluated.
using FunctionOfTime = std::function<double(double)>;

[[nodiscard]] Interpolant interpolate(const FunctionOfTime& f, double from, double to, int degree);

/// Two times of an interval at which its interpolant is held against the function: there, midway between two
/// nodes, what it does not resolve shows.
[[nodiscard]] std::vector<double> check_times(double from, double to, int degree);

/// Whether an interpolant shows a function whose derivatives at the nodes are `rates`, NaN where they are not
/// known: as far as slopes that differ tell, it agrees, or lies further from 0 than it disagrees.
[[nodiscard]] bool agrees_in_slope(const Interpolant& p, const std::vector<double>& rates, double round_off);

/// Where a part of a function is shown; true if the parts behind it need not be.
using ShowPart = std::function<bool(const Interpolant& part)>;

/// Looks where a function itself varies: shows interpolants of a function over parts of an interval, in their
/// order, each of which agrees with it at the times of the check, or lies further from 0 than it disagrees
/// there and beside kinks. `first` is that of the whole and `at_checks` the function's values there;
/// differences below `round_off` are none. At a kink or a jump parts end where they are as short as the flat
/// top of a smooth function.
///
/// False if the function varies faster than `most_parts` parts resolve. (What differs as much between times
/// next to each other is round-off, and remains as it is.)
[[nodiscard]] bool resolve(const FunctionOfTime& f, const Interpolant& first,
                           const std::vector<double>& at_checks, double round_off, std::size_t most_parts,
                           const ShowPart& show);

}  // namespace dalembert
