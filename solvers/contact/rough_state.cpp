#include "dalembert/solvers/contact/rough_state.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/accuracy.h>
#include <dalembert/solvers/contact/round_off.h>
#include <dalembert/solvers/manifold/spring_noise.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

using Eigen::VectorXd;

void RoughState::read_law(const System& stated) {
  const Roughness& law = *stated.conditions().of[number].roughness;
  pressed_by = static_cast<std::size_t>(law.pressed_by);
  const auto& contact = stated.conditions().of[pressed_by].contact;
  const std::size_t row =
      std::exchange(pressing_row, stated.layout()->constraints[pressed_by].own_rows().front());
  mu = law.mu;
  mu_static = law.mu_static;
  one_sided = contact.has_value();
  if (one_sided) {
    sign = contact->sign();
  } else if (row != pressing_row) {
    sign = 1.0;
  }
}

void RoughState::adopt(const Scales& scales, double tolerance) {
  speed = std::min(scales.speed(), (of_lengths * scales.length + of_angles) / scales.time);
  still = tolerance * speed;
  slow = Accuracy(tolerance).rest_in_space() * speed;
}

void RoughState::start_sliding(const VectorXd& along) {
  mode = Mode::slides;
  direction = along;
  pace = rows == 1 ? Pace::fast : Pace::leaves;
  blur = rows == 1 ? 0.0 : only_direction;
}

void RoughState::end_straight(const VectorXd& along) {
  direction = along;
  pace = Pace::straight;
  blur = only_direction;
  turns = 0.0;
}

VectorXd RoughState::part(std::span<const double> all) const {
  return Eigen::Map<const VectorXd>(all.data() + row, static_cast<Eigen::Index>(rows));
}

double RoughState::no_slip(double tolerance) const { return std::min(round_off(), 0.1 * tolerance) * speed; }

namespace {

/// The force along a row that takes away the accelerations by these forces.
double along(const System& system, std::span<const double> w, std::size_t row,
             std::span<const double> forces) {
  double acceleration = 0.0, of_unit = 0.0;
  for (const std::size_t k : system.row(row)) {
    const std::size_t i = system.w_columns()[k];
    acceleration += std::abs(w[k]) * forces[i] / system.masses()[i];
    of_unit += w[k] * w[k] / system.masses()[i];
  }
  return of_unit > 0.0 ? acceleration / of_unit : 0.0;
}

}  // namespace

void measure_gradients(std::span<RoughState> all, const System& stated, const Scales& scales,
                       const Instant& at) {
  if (all.empty()) return;
  auto e = stated.evaluation();
  std::vector<double> noise;
  try {
    stated.evaluate(at, e);
    noise = spring_noise(stated, scales, at);
  } catch (const EquationFault&) {
    return;  // of what is not in force there; the motion itself will say so, if it gets there
  }
  for (RoughState& r : all) {
    r.of_lengths = r.of_angles = 0.0;
    r.noise = along(stated, e.w, r.pressing_row, noise);
    for (std::size_t row = r.row; row < r.row + r.rows; ++row) {
      r.noise = std::max(r.noise, along(stated, e.w, row, noise));
      double of_lengths = 0.0, of_angles = 0.0;
      for (const std::size_t k : stated.row(row))
        (scales.is_angle[stated.w_columns()[k]] ? of_angles : of_lengths) += std::abs(e.w[k]);
      r.of_lengths = std::max(r.of_lengths, of_lengths);
      r.of_angles = std::max(r.of_angles, of_angles);
    }
  }
}

}  // namespace dalembert
