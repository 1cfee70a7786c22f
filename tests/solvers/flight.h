#pragma once

#include <dalembert/dalembert.h>

/// What moves along x alone.
namespace dalembert {

/// A particle of 1 kg.
struct Flight {
  Scene<2> scene{"flight"};
  Particle<2> body;

  Flight(double x, double v)
      : body(scene.add_particle({.mass = 1.0, .position = {x, 0.0}, .velocity = {v, 0.0}}, "body")) {}
  template <class V>
  void in_potential(V potential_of) {
    scene.add(potential(points(body), [potential_of](auto r) { return potential_of(r[0]); }), "V");
  }
  template <class Law>
  void push(Law law, const char* label) {
    scene.add(force_law(points(body),
                        [law](const auto& t, const auto& r, const auto& v) {
                          auto force = (0.0 * t * v).eval();
                          force[0] += law(t, r[0], v[0]);
                          return force;
                        }),
              label);
  }
};

/// The same, kept there by a table that bears nothing.
struct OnALine : Flight {
  OnALine(double x, double v) : Flight(x, v) { scene.add(OnCurve{body, Plane<2>{}}, "table"); }
};

}  // namespace dalembert
