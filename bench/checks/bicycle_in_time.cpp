#include "dalembert/bench/checks/bicycle_in_time.h"

#include <dalembert/core/linear/dense.h>
#include <dalembert/dalembert.h>
#include <dalembert/models/whipple_bicycle.h>

#include <string>

namespace dalembert::bench {

namespace {

constexpr double speed = 5.0;       // stable from 4.3 to 6.02 m/s
constexpr double lean_rate = 0.05;  // at first [rad/s]
constexpr double tolerance = 1e-10;

/// Columns: lean and steer, per unit of the first lean rate; a row per sample.
using Lateral = Eigen::MatrixX2d;

Lateral run(double rate, Stepper stepper) {
  const auto bicycle = models::WhippleBicycle{.speed = speed, .lean_rate = rate}.scene();
  const auto run =
      simulate(bicycle.scene, {.t_end = 5.0, .samples = 51, .tolerance = tolerance, .stepper = stepper});
  Lateral all(static_cast<Eigen::Index>(run.size()), 2);
  for (std::size_t i = 0; i < run.size(); ++i)
    all.row(static_cast<Eigen::Index>(i)) << bicycle.lean(run.sample(i)) / rate,
        bicycle.steer(run.sample(i)) / rate;
  return all;
}

/// The sum of the modes of the published equations, from upright with a lean rate of 1.
Lateral linear() {
  const auto [values, modes] = dense::complex_eigen(models::WhippleBicycle{.speed = speed}.published());
  const Eigen::VectorXcd amplitudes = dense::solve(modes, Eigen::Vector4cd(0.0, 0.0, 1.0, 0.0));
  Lateral all(51, 2);
  for (Eigen::Index i = 0; i < all.rows(); ++i) {
    const Eigen::VectorXcd grown = (values * (0.1 * static_cast<double>(i))).array().exp();
    for (Eigen::Index k = 0; k < 2; ++k)
      all(i, k) = modes.row(k).transpose().cwiseProduct(amplitudes).cwiseProduct(grown).sum().real();
  }
  return all;
}

}  // namespace

/// By symmetry lean and steer are odd in the disturbance: per unit of it they are the linear ones but for
/// powers of its square. Runs with a disturbance and half of it leave the fourth power, of the size of what
/// the second was, squared; and three times (8/3 + 1/3) the error of a run, for which stands, as elsewhere,
/// 100 times the tolerance.
void bicycle_in_time(std::vector<models::Compared>& all) {
  const Lateral expected = linear();
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    const Lateral whole = run(lean_rate, stepper), half = run(lean_rate / 2.0, stepper);
    const Lateral found = (4.0 * half - whole) / 3.0;
    for (const Eigen::Index i : {Eigen::Index(0), Eigen::Index(1)}) {
      const double size = expected.col(i).lpNorm<Eigen::Infinity>();
      const double second = 4.0 / 3.0 * (whole - half).col(i).lpNorm<Eigen::Infinity>() / size;
      const double error = (found - expected).col(i).lpNorm<Eigen::Infinity>() / size;
      all.push_back({"bicycle", std::string(i == 0 ? "lean" : "steer") + " in time, " + name(stepper), error,
                     0.0, second * second + 300.0 * tolerance / (size * lean_rate)});
    }
  }
}

}  // namespace dalembert::bench
