#include "dalembert/models/lecture_scenes.h"

#include <dalembert/models/heavy_top.h>

#include <utility>

namespace dalembert::models {

namespace {

/// mln36: two particles on a rod, one on a sphere, the other carried round by a plane.
LectureScene dumbbell() {
  Scene<3> scene("dumbbell");
  scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
  const auto a = scene.add_particle({.mass = 1.0, .position = {0.0, 0.0, -1.0}}, "a");
  const auto b =
      scene.add_particle({.mass = 1.0, .position = {0.6, 0.0, -1.8}, .velocity = {0.0, 1.2, 0.0}}, "b");
  scene.add(Distance{a, b, 1.0}, "rod");
  scene.add(OnSurface{a, Sphere<3>{}}, "sphere");
  scene.add(RotatingPlane{b, Axis{}, [](auto t) { return 2.0 * t; }}, "turning plane");
  return {std::move(scene), 3.0};
}

/// mex22: the motion of the quartic Lagrangian, on a wire along x.
LectureScene double_well() {
  Scene<2> scene("double-well");
  const auto bead = scene.add_particle({.mass = 1.5, .position = {0.2, 0.0}, .velocity = {0.9, 0.0}}, "bead");
  scene.add(OnCurve{bead, [](auto r) { return r.y(); }}, "wire");
  scene.add(potential(points(bead),
                      [](auto r) {
                        const auto square = r.x() * r.x();
                        return 1.0 - square / 2.0 + square * square / 4.0;
                      }),
            "well");
  return {std::move(scene), 10.0};
}

/// mex79: a particle in the potential 2 x^2 + 3 y^2.
LectureScene oscillator() {
  Scene<2> scene("oscillator");
  const auto particle =
      scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}, .velocity = {0.3, 1.0}}, "particle");
  scene.add(potential(points(particle), [](auto r) { return 2.0 * r.x() * r.x() + 3.0 * r.y() * r.y(); }),
            "well");
  return {std::move(scene), 10.0};
}

/// Its axis starts at rest, so it nods.
LectureScene nodding_top() { return {HeavyTop{.lean = 0.5, .spin = 300.0}.scene().scene, 3.0}; }

}  // namespace

std::vector<LectureScene> lecture_scenes() {
  std::vector<LectureScene> all;
  all.push_back(dumbbell());
  all.push_back(double_well());
  all.push_back(oscillator());
  all.push_back(nodding_top());
  return all;
}

}  // namespace dalembert::models
