#pragma once

#include <dalembert/core/equations/arguments.h>
#include <dalembert/solvers/base/hidden.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The accelerations of the last steps, for extrapolation where those of the equations are lost to round-off:
///
///   v(t) = v0 + int p,   q(t) = q0 + (t - t0) v0 + int int p,   p through a at the last nodes  (Adams)
///
/// Close to a singular position at t*, sin ~ |t - t*|, positions are accurate to eps/sin, velocities to
/// eps/sin^2, accelerations to eps/sin^3. Nodes whose distances from t* double, and a point as far beyond t*
/// as the last one is before it, amplify the noise in a (t - t0) by about 20 whatever their number. A
/// polynomial through q and v as well would be of higher order, but amplify the noise in q by 1e4.
class SingularExtrapolation {
 public:
  static constexpr std::size_t most_nodes = 7;

  explicit SingularExtrapolation(std::size_t n);
  SingularExtrapolation(const SingularExtrapolation&) = delete;
  SingularExtrapolation& operator=(const SingularExtrapolation&) = delete;

  /// After each step, and before the first: the accelerations at t.
  void remember(double t, std::span<const double> a);
  /// Forgets accelerations that the next ones do not continue.
  void forget() { known_ = 0; }

  /// Chooses, from the last node back, those whose distances from `singular` grow by at least `node_ratio`.
  /// Returns how many: at most `most_nodes`.
  std::size_t choose(double singular);
  /// Forgets all others: closer to `singular` they will not be needed.
  void keep_chosen();
  /// Through the first `nodes` of those chosen (also after one more `remember`): moves q0, v0 at the last
  /// node to the time t. The three spans of results may be q0, v0 themselves; `a` may be empty.
  void go(std::size_t nodes, double t, std::span<const double> q0, std::span<const double> v0,
          std::span<double> q, std::span<double> v, std::span<double> a) const;

  /// Between the last of those nodes and the state beyond t*, once that is known: a(t) = p(t) + (alpha +
  /// beta t) prod (t - t_j), alpha and beta so that q and v are met there. Interpolated, their noise and that
  /// of the accelerations is not amplified; and B^2 < A C for the moments A, B, C of a product that does not
  /// change its sign between both ends (Cauchy, Schwarz), so there always is one such polynomial.
  void read(std::size_t nodes, double t, const Instant& from, const Instant& to, std::span<double> q,
            std::span<double> v) const;

 private:
  /// The chosen nodes: their times from the last one's, over a length.
  [[nodiscard]] std::array<double, most_nodes> places(double length) const;

  struct Past {
    double t = 0.0;
    double* a = nullptr;
  };
  std::vector<double> accelerations_;
  std::vector<Past> past_;  // the last one first
  std::size_t known_ = 0;
  std::array<std::size_t, most_nodes> chosen_{};
  std::size_t count_ = 0;  // of those
};

}  // namespace dalembert
