#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/erk/stages.h>

namespace dalembert {

namespace {

/// Steps of h rho beyond this are limited by stability: |R(iy)| exceeds 1 by a thousandth at
/// y = 3.3, by a twentieth at 4.4, and |R(-x)| exceeds 1 at x = 5.9 (from the table of the pair).
constexpr double stable = 3.3;

}  // namespace

ErkStepper::Stages::Stages(std::size_t coordinates)
    : n_(coordinates), a_(pair.a.begin(), pair.a.end()), after_first_((count - 1) * 3 * n_) {
  for (std::size_t i = 1; i < count; ++i) k_[i] = (*this)[i].v.data();
}

void ErkStepper::Stages::finish(const Node& start, double h, Node& end) const {
  end.t = start.t + h;
  b_.move(h, k_, start.x.data(), end.x.data(), 2 * n_);
}

/// The last two stages lie at the same time; the ratio of their derivatives' difference to their
/// own is the largest rate rho that the step has excited (Hairer, Wanner, Solving ODEs II, IV.2).
bool ErkStepper::Stages::at_limit_of_stability(double h, const Scales& scales) const {
  const double T2 = scales.time * scales.time;
  double rates = 0.0, states = 0.0;
  for (std::size_t i = 0; i < n_; ++i) {
    double dq = 0.0;
    for (std::size_t j = 0; j < count; ++j)
      dq += h * (pair.a[count - 1][j] - pair.a[count - 2][j]) * k_[j][i];
    const double dv = k_[count - 1][i] - k_[count - 2][i];
    const double da = k_[count - 1][n_ + i] - k_[count - 2][n_ + i];
    rates += dv * dv + T2 * da * da;
    states += dq * dq + T2 * dv * dv;
  }
  const double round_off = 100.0 * epsilon * scales.length;
  return states > round_off * round_off && h * h * rates > stable * stable * states;
}

}  // namespace dalembert
