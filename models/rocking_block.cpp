#include "dalembert/models/rocking_block.h"

#include <dalembert/models/event_times.h>
#include <dalembert/models/numbered.h>

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/special_functions/sinc.hpp>

#include <cmath>
#include <limits>

namespace dalembert::models {

namespace {

/// The lower one of two corners 2 b apart stays at -b or b.
auto lower_corner_stays(const BodyPoint<2>& left, const BodyPoint<2>& right, double b) {
  return holonomic(points(left, right), [b](auto l, auto r) {
    const auto s = (l.y() - r.y()) / (2.0 * b);
    return (l.x() + r.x()) / 2.0 - b * s * abs(s) / (1.0 + sqrt(1.0 - s * s));
  });
}

}  // namespace

RockingBlock::Built RockingBlock::scene() const {
  Scene<2> scene("rocking-block");
  scene.add(UniformGravity<2>{{0.0, -gravity}});
  const double b = half_width, h = half_height, R = std::hypot(b, h), a = std::atan2(b, h);
  const auto block = add_body(scene,
                              BodyState<2>{.mass = mass,
                                           .inertia = mass * R * R / 3.0,
                                           .centre = {b - R * std::sin(a - tilt), R * std::cos(a - tilt)},
                                           .angle = -tilt},
                              "block");
  const auto left_corner = block.point({-b, -h}), right_corner = block.point({b, -h});
  const auto y = [](auto r) { return r.y(); };
  const auto left = scene.add(unilateral(holonomic(points(left_corner), y)), "left corner");
  const auto right = scene.add(unilateral(holonomic(points(right_corner), y)), "right corner");
  if (floor == Floor::rough) scene.add(lower_corner_stays(left_corner, right_corner, b), "no sliding");
  return {.scene = std::move(scene), .block = block, .left = left, .right = right};
}

double RockingBlock::inertia(double theta) const {
  const double R = std::hypot(half_width, half_height), a = std::atan2(half_width, half_height);
  const double arm = floor == Floor::rough ? R : R * std::sin(a - theta);
  return mass * (R * R / 3.0 + arm * arm);
}

double RockingBlock::ratio() const {
  const double opposed = 2.0 * mass * half_width * half_width;
  return 1.0 - opposed / inertia(0.0);
}

double RockingBlock::drop(int k) const {
  const double a = std::atan2(half_width, half_height);
  return std::pow(ratio(), 2 * k) * 2.0 * std::sin(a - tilt / 2.0) * std::sin(tilt / 2.0);
}

double RockingBlock::impact_rate(int k) const {
  const double R = std::hypot(half_width, half_height);
  return std::sqrt(2.0 * mass * gravity * R * drop(k) / inertia(0.0));
}

double RockingBlock::quarter(int k) const {
  const double R = std::hypot(half_width, half_height), a = std::atan2(half_width, half_height);
  const double x = drop(k), s = std::sin(a);
  const double largest = 2.0 * std::atan(x / (s + std::sqrt(s * s - x * (2.0 * std::cos(a) + x))));
  boost::math::quadrature::tanh_sinh<double> integrator;
  return integrator.integrate(
      [&](double u) {  // cos(a - theta_k) - cos(a - theta) = 2 sin(a - theta_k + u^2/2) sin(u^2/2)
        const double fall = std::sin(a - largest + u * u / 2.0) * boost::math::sinc_pi(u * u / 2.0);
        return 2.0 * std::sqrt(inertia(largest - u * u) / (2.0 * mass * gravity * R * fall));
      },
      0.0, std::sqrt(largest));
}

double RockingBlock::impact_time(int k) const {
  double time = quarter(0);
  for (int i = 1; i <= k; ++i) time += 2.0 * quarter(i);
  return time;
}

double RockingBlock::rest_time() const {
  int last = 0;  // what follows is no more than its last digit
  while (impact_rate(last) > std::numeric_limits<double>::epsilon() * impact_rate(0)) ++last;
  return impact_time(last);
}

EventModel RockingBlock::event_model() const {
  const std::string name = floor == Floor::rough ? "rocking-block" : "rocking-block-on-ice";
  return {.name = name, .notes = "", .events = [*this](const EventRun& how) {
            const Built built = scene();
            const double rests = rest_time(), limit = time_limit(how.tolerance);
            const auto run = how.run(built.scene, {.t_end = 1.1 * rests, .samples = 2});
            std::vector<Timed> all;
            for (int k = 0; impact_rate(k) > 0.01 * impact_rate(0); ++k)
              all.push_back({numbered("impact ", k + 1),
                             time_of(run, k % 2 == 0 ? built.left : built.right, EventKind::struck, k / 2),
                             impact_time(k), limit});
            // By ida their limit, rest, is known to hundreds of tolerances only: the smaller impacts are, the
            // fewer digits of their speeds are above the tolerance of the run.
            if (how.stepper == Stepper::erk)
              all.push_back({"rests", time_of(run, built.left, EventKind::rested), rests, limit});
            return all;
          }};
}

}  // namespace dalembert::models
