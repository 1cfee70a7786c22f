#pragma once

#include <dalembert/models/chain.h>

#include <vector>

namespace dalembert::bench {

/// The chain in Cartesian coordinates, y = (x_1, y_1, x_2, ... y_N, and their rates): no sine or cosine.
///
/// With d_i = r_i - r_(i-1), w_i = v_i - v_(i-1), r_0 = v_0 = 0, and s_i = tension_i / (m l), Newton's law is
///
///   a_i = g + s_(i+1) d_(i+1) - s_i d_i,     s_(N+1) = 0,
///
/// and d_i . (a_i - a_(i-1)) + w_i . w_i = 0, the second derivative of |d_i| = l, with a_0 = 0, is a
/// symmetric tridiagonal system for the tensions:
///
///   -d_i . d_(i-1) s_(i-1) + 2 d_i . d_i s_i - d_i . d_(i+1) s_(i+1) = w_i . w_i
///   d_1 . d_1 s_1 - d_1 . d_2 s_2 = w_1 . w_1 + g . d_1
///
/// The lengths of the rods hold only as well as they are integrated: nothing corrects them.
class CartesianChain {
 public:
  explicit CartesianChain(const models::Chain& chain);

  [[nodiscard]] std::vector<double> start() const;
  void operator()(const std::vector<double>& y, std::vector<double>& y_rate);
  [[nodiscard]] models::Observation<2> observation(const std::vector<double>& y);

 private:
  /// Rod i of the chain, numbered from 0, and its row of the system.
  struct Rod {
    Vec<2> d = Vec<2>::Zero();
    double next = 0.0;   ///< d . d of the next rod
    double pivot = 0.0;  ///< inverse, after elimination
    double s = 0.0;
  };
  /// By elimination without exchanges: the matrix is positive definite.
  void find_tensions(const std::vector<double>& y);

  std::size_t n_;
  double link_, bead_;
  Vec<2> gravity_;
  std::vector<Rod> rods_;
};

}  // namespace dalembert::bench
