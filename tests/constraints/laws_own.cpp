#include "laws.h"
#include <dalembert/constraints/holonomic.h>
#include <dalembert/constraints/nonholonomic.h>

namespace dalembert::laws::laws_own_test {
namespace {

// clang-format off: one line for each constraint type
const bool registered = [] {
  any<2>("ScleronomicHolonomic", [](auto& scene, auto&, auto a, auto b) {
    scene.add(holonomic(points(a, b), [](auto r_a, auto r_b) {
      return r_a.x() * r_b.y() - exp(r_a.y()) + r_b.squaredNorm();
    }));
  });
  any<2>("RheonomicHolonomic", [](auto& scene, auto&, auto a, auto b) {
    scene.add(holonomic(points(a, b),
                        [](auto t, auto r_a, auto r_b) { return r_a.x() * sin(t * r_b.y()) + t * t * t; }));
  });
  any<3>("HolonomicOfTwoEquations", [](auto& scene, auto&, auto a, auto b) {
    scene.add(holonomic(points(b, a), [](auto t, auto r_b, auto r_a) {
      return vec(r_a.dot(r_b) - t, r_a.cross(r_b).norm());
    }));
  });
  any<2>("HolonomicOfADrivenPoint", [](auto& scene, auto&, auto a, auto) {
    scene.add(holonomic(points(driven([](auto t) { return vec(t, sin(t)); }), a),
                        [](auto r_d, auto r_a) { return r_d.x() * r_a.x() + r_d.y() * r_a.y(); }));
  });
  any<2>("ScleronomicNonholonomic", [](auto& scene, auto&, auto a, auto) {
    scene.add(
        nonholonomic(points(a), [](auto r, auto v) { return v.y() * cos(r.x()) - r.y() * r.x() * v.x(); }));
  });
  any<2>("RheonomicNonholonomic", [](auto& scene, auto&, auto a, auto) {
    scene.add(nonholonomic(points(a),
                           [](auto t, auto r, auto v) { return v.y() - sin(t * r.x()) * v.x() - t * t; }));
  });
  any<3>("NonholonomicOfTwoEquations", [](auto& scene, auto&, auto a, auto b) {
    scene.add(nonholonomic(points(a, b), [](auto r_a, auto r_b, auto v_a, auto v_b) {
      return vec(v_a.dot(r_b), r_a.cross(v_b).x());
    }));
  });
  any<2>("NonholonomicOfADrivenPoint", [](auto& scene, auto&, auto a, auto) {
    scene.add(nonholonomic(points(a, driven([](auto t) { return vec(t, sin(2.0 * t)); })),
                           [](auto r_a, auto r_d, auto v_a, auto v_d) {
                             return (r_d - r_a).dot(v_d - v_a) + r_d.x() * v_d.y();
                           }));
  });
  invariant<2>("PursuitOfADrivenPoint", [](auto& scene, auto& at, auto a, auto) {
    scene.add(nonholonomic(points(a, driven([at](auto t) { return at.point(t, sin(2.0 * t)); })),
                           [](auto r_a, auto r_d, auto v_a, auto) {
                             return v_a.x() * (r_d - r_a).y() - v_a.y() * (r_d - r_a).x();
                           }));
  });
  return true;
}();
// clang-format on

}  // namespace
}  // namespace dalembert::laws::laws_own_test
