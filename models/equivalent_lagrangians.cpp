#include <dalembert/models/two_formulations.h>

#include <algorithm>
#include <cmath>

namespace dalembert::models {

namespace {

/// The motions of two systems, the second one's coordinates brought to those of the first by `map`([t,] q).
template <int N, int K, class Map>
TwoFormulations same_motion(std::string model, std::string notes, std::string what, LagrangianSystem<N> first,
                            LagrangianSystem<K> second, Map map) {
  return {std::move(model), std::move(notes), std::move(what),
          [first = std::move(first), second = std::move(second), map](const Options& options) {
            const auto a = simulate(first, options);
            const auto b = simulate(second, options);
            double difference = 0.0, size = 0.0;
            for (std::size_t i = 0; i < a.size(); ++i) {
              const auto mapped = map(a.times()[i], b.position(i));
              difference = std::max(difference, (a.position(i) - mapped).cwiseAbs().maxCoeff());
              size = std::max(size, a.position(i).cwiseAbs().maxCoeff());
            }
            return difference / size;
          }};
}

const auto as_it_is = [](double /*t*/, const auto& q) { return q; };

TwoFormulations gauge() {  // F = sin(t) q^3
  const CoordinateState<1> start{.position = Vec<1>(1.0)};
  const auto pendulum = [](const auto& q, const auto& v) { return 0.5 * v[0] * v[0] + 9.81 * cos(q[0]); };
  return same_motion("plane-pendulum", "mex21", "L and L + dF/dt", LagrangianSystem<1>(start, pendulum),
                     LagrangianSystem<1>(start,
                                         [pendulum](const auto& t, const auto& q, const auto& v) {
                                           const auto cube = q[0] * q[0] * q[0];
                                           return pendulum(q, v) + cos(t) * cube +
                                                  3.0 * sin(t) * q[0] * q[0] * v[0];
                                         }),
                     as_it_is);
}

template <class W>
TwoFormulations quartic(const std::string& well, double x, double rate, W potential) {
  constexpr double m = 1.5;
  const CoordinateState<1> start{.position = Vec<1>(x), .velocity = Vec<1>(rate)};
  return same_motion(
      "quartic-lagrangian", "mex22", "quartic and T - W: " + well,
      LagrangianSystem<1>(
          start, [=](const auto& q, const auto& v) { return 0.5 * m * v[0] * v[0] - potential(q[0]); }),
      LagrangianSystem<1>(start,
                          [=](const auto& q, const auto& v) {
                            const auto square = m * v[0] * v[0], W_here = potential(q[0]);
                            return square * square / 12.0 + square * W_here - W_here * W_here;
                          }),
      as_it_is);
}

/// A particle in the plane in the potential 2 x^2 + 3 y^2.
LagrangianSystem<2> oscillator() {
  return LagrangianSystem<2>(
      {.position = {1.0, 0.2}, .velocity = {0.3, 1.0}}, [](const auto& q, const auto& v) {
        return 0.5 * (v[0] * v[0] + v[1] * v[1]) - 2.0 * q[0] * q[0] - 3.0 * q[1] * q[1];
      });
}

TwoFormulations polar() {
  const auto cartesian = oscillator();
  const Vec<2> r = cartesian.position(), u = cartesian.velocity();
  const LagrangianSystem<2> system(
      {.position = {r.norm(), std::atan2(r.y(), r.x())},
       .velocity = {r.dot(u) / r.norm(), detail::moment(r, u) / r.squaredNorm()}},
      [](const auto& q, const auto& v) {
        const auto x = q[0] * cos(q[1]), y = q[0] * sin(q[1]);
        return 0.5 * (v[0] * v[0] + q[0] * q[0] * v[1] * v[1]) - 2.0 * x * x - 3.0 * y * y;
      });
  return same_motion(
      "plane-oscillator", "mex79", "Cartesian and polar", cartesian, system,
      [](double, const Vec<2>& q) { return vec(q[0] * std::cos(q[1]), q[0] * std::sin(q[1])); });
}

TwoFormulations turning() {  // X the coordinates in a frame that turns at W: r' = R(W t) (X' + W e_z x X)
  constexpr double W = 1.3;
  const auto fixed = oscillator();
  const Vec<2> r = fixed.position(), u = fixed.velocity();
  const LagrangianSystem<2> system({.position = r, .velocity = u - W * Vec<2>(-r.y(), r.x())},
                                   [](const auto& t, const auto& q, const auto& v) {
                                     const auto v_x = v[0] - W * q[1], v_y = v[1] + W * q[0];
                                     const auto x = q[0] * cos(W * t) - q[1] * sin(W * t),
                                                y = q[0] * sin(W * t) + q[1] * cos(W * t);
                                     return 0.5 * (v_x * v_x + v_y * v_y) - 2.0 * x * x - 3.0 * y * y;
                                   });
  return same_motion("plane-oscillator", "mex79", "at rest and in a turning frame", fixed, system,
                     [](double t, const Vec<2>& q) {
                       const double cosine = std::cos(W * t), sine = std::sin(W * t);
                       return vec(q[0] * cosine - q[1] * sine, q[0] * sine + q[1] * cosine);
                     });
}

TwoFormulations routhian() {  // the rod whose foot slides: m = l = 1, x is cyclic
  const LagrangianSystem<2> rod(
      {.position = {0.0, 1.0}, .velocity = {0.3, 0.4}}, [](const auto& q, const auto& v) {
        const auto along = v[0] + 0.5 * v[1] * cos(q[1]), up = 0.5 * v[1] * sin(q[1]);
        return 0.5 * (along * along + up * up) + v[1] * v[1] / 24.0 - 9.81 * 0.5 * cos(q[1]);
      });
  const LagrangianSystem<1> swinging = reduced(rod, 0).system;
  return {"sliding-rod", "mex115", "L and its Routhian", [rod, swinging](const Options& options) {
            const auto all = simulate(rod, options);
            const auto one = simulate(swinging, options);
            double difference = 0.0, size = 0.0;
            for (std::size_t i = 0; i < all.size(); ++i) {
              difference = std::max(difference, std::abs(all.position(i)[1] - one.position(i)[0]));
              size = std::max(size, std::abs(all.position(i)[1]));
            }
            return difference / size;
          }};
}

}  // namespace

std::vector<TwoFormulations> equivalent_lagrangians() {
  return {gauge(),
          quartic("2 x^2", 1.0, 0.5, [](const auto& x) { return 2.0 * x * x; }),
          quartic("a double well", 0.2, 0.9,
                  [](const auto& x) { return 1.0 - x * x / 2.0 + x * x * x * x / 4.0; }),
          quartic("a pendulum's", 2.0, 0.0, [](const auto& x) { return 9.81 * (1.0 - cos(x)); }),
          polar(),
          turning(),
          routhian()};
}

}  // namespace dalembert::models
