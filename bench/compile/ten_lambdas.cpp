#include <dalembert/dalembert.h>

int main() {
  using namespace dalembert;

  Scene<2> scene;
  const auto a = scene.add_particle({.mass = 1.0, .position = {0.0, 0.0}});
  const auto b = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  scene.add(holonomic(points(a, b), [](auto r_a, auto r_b) { return (r_b - r_a).norm() - 1.0; }));
  scene.add(holonomic(points(a, b), [](auto r_a, auto r_b) { return (r_b - r_a).squaredNorm() - 1.0; }));
  scene.add(holonomic(points(a), [](auto r) { return r.norm() - 1.0; }));
  scene.add(holonomic(points(a), [](auto r) { return r.y() - r.x() * r.x(); }));
  scene.add(holonomic(points(a), [](auto r) { return r.y() - sin(r.x()); }));
  scene.add(holonomic(points(b), [](auto r) { return r.y() + cos(2.0 * r.x()); }));
  scene.add(holonomic(points(b), [](auto t, auto r) { return r.y() - 0.1 * sin(10.0 * t); }));
  scene.add(holonomic(points(a, b), [](auto r_a, auto r_b) { return vec(r_a.x() - r_b.x(), r_a.y()); }));
  scene.add(nonholonomic(points(a), [](auto r, auto v) { return v.y() - r.x() * v.x(); }));
  scene.add(nonholonomic(points(a, b),
                         [](auto r_a, auto r_b, auto v_a, auto v_b) { return (r_b - r_a).dot(v_a + v_b); }));
  return simulate(scene, {.t_end = 1.0, .samples = 2}).size() == 2 ? 0 : 1;
}
