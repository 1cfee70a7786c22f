#include <dalembert/models/cone.h>
#include <dalembert/models/disk_on_rotating_track.h>
#include <dalembert/models/double_pendulum.h>
#include <dalembert/models/driven_pivot.h>
#include <dalembert/models/governor.h>
#include <dalembert/models/hoop_about_diameter.h>
#include <dalembert/models/hoop_about_external_axis.h>
#include <dalembert/models/parabolic_slide.h>
#include <dalembert/models/plane_pendulum.h>
#include <dalembert/models/sliding_pivot.h>
#include <dalembert/models/sliding_rod.h>
#include <dalembert/models/two_formulations.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dalembert::models {

namespace {

template <int D, int N>
TwoFormulations formulations(std::string model, std::string notes, Scene<D> scene, LagrangianSystem<N> system,
                             Embedding<D, N> embedding) {
  return {std::move(model), std::move(notes), "particles and Lagrangian",
          [scene = std::move(scene), system = std::move(system),
           embedding = std::move(embedding)](const Options& options) {
            const CrossCheck check = cross_check(scene, system, embedding, options);
            return std::max({check.position.relative(), check.velocity.relative(), check.force.relative()});
          }};
}

/// Out of a length and an angle from the downward vertical.
auto hanging(double length, const auto& angle) { return vec(length * sin(angle), -length * cos(angle)); }

TwoFormulations plane_pendulum() {
  const PlanePendulum p;
  const auto built = p.scene();
  const LagrangianSystem<1> system({.position = Vec<1>(p.amplitude)}, [p](const auto& q, const auto& v) {
    return 0.5 * p.mass * p.length * p.length * v[0] * v[0] + p.mass * p.gravity * p.length * cos(q[0]);
  });
  Embedding<2, 1> embedding;
  embedding.add(built.beads[0], [p](const auto& q) { return hanging(p.length, q[0]); });
  return formulations("plane-pendulum", "mln77", built.scene, system, embedding);
}

TwoFormulations cone() {
  const ConeSlide p;
  const auto built = p.scene();
  const double sine = std::sin(p.half_angle), cotangent = 1.0 / std::tan(p.half_angle);
  const LagrangianSystem<2> system({.position = {p.start_radius, 0.0},
                                    .velocity = {0.0, p.speed_ratio * std::sqrt(p.gravity / p.start_radius)},
                                    .scale = {p.start_radius, 1.0}},
                                   [=](const auto& q, const auto& v) {
                                     return 0.5 * p.mass *
                                                (v[0] * v[0] / (sine * sine) + q[0] * q[0] * v[1] * v[1]) -
                                            p.mass * p.gravity * cotangent * q[0];
                                   });
  Embedding<3, 2> embedding;
  embedding.add(built.particle,
                [=](const auto& q) { return vec(q[0] * cos(q[1]), q[0] * sin(q[1]), cotangent * q[0]); });
  return formulations("cone", "mln77", built.scene, system, embedding);
}

TwoFormulations double_pendulum() {
  const DoublePendulum p;
  const auto built = p.scene();
  const LagrangianSystem<2> system({.position = {p.angle1, p.angle2}}, [p](const auto& q, const auto& v) {
    const double m = p.mass1 + p.mass2;
    return 0.5 * m * p.length1 * p.length1 * v[0] * v[0] +
           0.5 * p.mass2 * p.length2 * p.length2 * v[1] * v[1] +
           p.mass2 * p.length1 * p.length2 * v[0] * v[1] * cos(q[0] - q[1]) +
           m * p.gravity * p.length1 * cos(q[0]) + p.mass2 * p.gravity * p.length2 * cos(q[1]);
  });
  Embedding<2, 2> embedding;
  embedding.add(built.beads[0], [p](const auto& q) { return hanging(p.length1, q[0]); });
  embedding.add(built.beads[1],
                [p](const auto& q) { return (hanging(p.length1, q[0]) + hanging(p.length2, q[1])).eval(); });
  return formulations("double-pendulum", "mex20", built.scene, system, embedding);
}

TwoFormulations parabolic_slide() {
  const ParabolicSlide p;
  const auto built = p.scene();
  const LagrangianSystem<1> system({.position = Vec<1>(p.amplitude), .scale = Vec<1>(p.amplitude)},
                                   [p](const auto& q, const auto& v) {
                                     const auto slope = 2.0 * p.curvature * q[0];
                                     return 0.5 * p.mass * (1.0 + slope * slope) * v[0] * v[0] -
                                            p.mass * p.gravity * p.curvature * q[0] * q[0];
                                   });
  Embedding<2, 1> embedding;
  embedding.add(built.bead, [p](const auto& q) { return vec(q[0], p.curvature * q[0] * q[0]); });
  return formulations("parabolic-slide", "mex131", built.scene, system, embedding);
}

TwoFormulations sliding_pivot() {
  const SlidingPivot p;
  const auto built = p.scene();
  const LagrangianSystem<2> system(
      {.position = {0.0, p.angle}, .scale = {p.length, 1.0}}, [p](const auto& q, const auto& v) {
        return 0.5 * (p.block_mass + p.bob_mass) * v[0] * v[0] +
               0.5 * p.bob_mass *
                   (p.length * p.length * v[1] * v[1] + 2.0 * p.length * v[0] * v[1] * cos(q[1])) +
               p.bob_mass * p.gravity * p.length * cos(q[1]);
      });
  Embedding<2, 2> embedding;
  embedding.add(built.block, [](const auto& q) { return vec(q[0], 0.0); });
  embedding.add(built.bob,
                [p](const auto& q) { return vec(q[0] + p.length * sin(q[1]), -p.length * cos(q[1])); });
  return formulations("sliding-pivot", "mex24", built.scene, system, embedding);
}

TwoFormulations sliding_rod() {
  const SlidingRod p;
  const auto built = p.scene();
  const double half = p.length / 2.0, inertia = p.mass * p.length * p.length / 12.0;
  const LagrangianSystem<2> system(
      {.position = {0.0, p.angle}, .velocity = {p.drift, 0.0}, .scale = {p.length, 1.0}},
      [=](const auto& q, const auto& v) {
        const auto along = v[0] + half * v[1] * cos(q[1]), up = half * v[1] * sin(q[1]);
        return 0.5 * p.mass * (along * along + up * up) + 0.5 * inertia * v[1] * v[1] -
               p.mass * p.gravity * half * cos(q[1]);
      });
  Embedding<2, 2> embedding;
  for (const std::size_t i : {0U, 1U}) {
    const double from_foot = half + (i == 0 ? -1.0 : 1.0) * built.rod.arms[0];
    embedding.add(built.rod.particles[i],
                  [=](const auto& q) { return vec(q[0] + from_foot * sin(q[1]), from_foot * cos(q[1])); });
  }
  return formulations("sliding-rod", "mex115", built.scene, system, embedding);
}

TwoFormulations hoop_about_external_axis() {
  const HoopAboutExternalAxis p;
  const auto built = p.scene();
  const LagrangianSystem<1> system({.position = Vec<1>(p.amplitude)}, [p](const auto& q, const auto& v) {
    const auto turning = v[0] + p.spin;
    return 0.5 * p.mass *
           (p.radius * p.radius * turning * turning +
            2.0 * p.radius * p.offset * p.spin * turning * cos(q[0]));
  });
  Embedding<2, 1> embedding;
  embedding.add(built.bead, [p](const auto& t, const auto& q) {
    const auto turned = p.spin * t;
    return vec(p.offset * cos(turned) + p.radius * cos(turned + q[0]),
               p.offset * sin(turned) + p.radius * sin(turned + q[0]));
  });
  return formulations("hoop-about-external-axis", "mex25", built.scene, system, embedding);
}

TwoFormulations hoop_about_diameter() {
  const HoopAboutDiameter p;
  const auto built = p.scene();
  const LagrangianSystem<1> system({.position = Vec<1>(p.angle)}, [p](const auto& q, const auto& v) {
    const auto around = p.spin * sin(q[0]);
    return 0.5 * p.mass * p.radius * p.radius * (v[0] * v[0] + around * around) +
           p.mass * p.gravity * p.radius * cos(q[0]);
  });
  Embedding<3, 1> embedding;
  embedding.add(built.bead, [p](const auto& t, const auto& q) {
    const auto out = p.radius * sin(q[0]);
    return vec(out * cos(p.spin * t), out * sin(p.spin * t), -p.radius * cos(q[0]));
  });
  return formulations("hoop-about-diameter", "mex39", built.scene, system, embedding);
}

TwoFormulations governor() {
  const Governor p;
  const auto built = p.scene();
  const LagrangianSystem<1> system({.position = Vec<1>(p.angle)}, [p](const auto& q, const auto& v) {
    const auto sine = sin(q[0]);
    const double L2 = p.length * p.length;
    return p.mass * L2 * (v[0] * v[0] + p.spin * p.spin * sine * sine) +
           2.0 * p.sleeve_mass * L2 * v[0] * v[0] * sine * sine +
           2.0 * (p.mass + p.sleeve_mass) * p.gravity * p.length * cos(q[0]);
  });
  Embedding<3, 1> embedding;
  for (const std::size_t i : {0U, 1U}) {
    const double ahead = i == 0 ? 0.0 : std::numbers::pi;
    embedding.add(built.parts.masses[i], [p, ahead](const auto& t, const auto& q) {
      const auto out = p.length * sin(q[0]), turned = p.spin * t + ahead;
      return vec(out * cos(turned), out * sin(turned), -p.length * cos(q[0]));
    });
  }
  embedding.add(built.parts.sleeve,
                [p](const auto& q) { return vec(0.0, 0.0, -2.0 * p.length * cos(q[0])); });
  return formulations("governor", "mex23", built.scene, system, embedding);
}

TwoFormulations disk_on_rotating_track() {
  const DiskOnRotatingTrack p;
  const auto built = p.scene();
  const double inertia = p.inertia_ratio * p.mass * p.radius * p.radius;
  const LagrangianSystem<1> system(
      {.position = Vec<1>(p.start), .scale = Vec<1>(p.start)}, [=](const auto& q, const auto& v) {
        const auto along = v[0] - p.radius * p.spin, spin = p.spin - v[0] / p.radius;
        return 0.5 * p.mass * (along * along + p.spin * p.spin * q[0] * q[0]) + 0.5 * inertia * spin * spin;
      });
  Embedding<2, 1> embedding;
  embedding.add(built.centre, [p](const auto& t, const auto& q) {
    const auto cosine = cos(p.spin * t), sine = sin(p.spin * t);
    return vec(q[0] * cosine - p.radius * sine, q[0] * sine + p.radius * cosine);
  });
  embedding.add(built.wheel,
                [p](const auto& t, const auto& q) { return p.spin * t - (q[0] - p.start) / p.radius; });
  return formulations("disk-on-rotating-track", "mex116", built.scene, system, embedding);
}

TwoFormulations driven_pivot(const DrivenPivot& p, const std::string& direction, const std::string& notes) {
  const auto built = p.scene();
  const LagrangianSystem<1> system(
      {.position = Vec<1>(p.angle)}, [p](const auto& t, const auto& q, const auto& v) {
        const double w = p.frequency;
        const auto u_x = -p.amplitude_x * w * sin(w * t), u_y = -p.amplitude_y * w * sin(w * t + p.phase);
        const auto v_x = u_x + p.length * v[0] * cos(q[0]), v_y = u_y + p.length * v[0] * sin(q[0]);
        const auto height = p.pivot(t)[1] - p.length * cos(q[0]);
        return 0.5 * p.mass * (v_x * v_x + v_y * v_y) - p.mass * p.gravity * height;
      });
  Embedding<2, 1> embedding;
  embedding.add(built.bob,
                [p](const auto& t, const auto& q) { return (p.pivot(t) + hanging(p.length, q[0])).eval(); });
  return formulations("driven-pivot-" + direction, notes, built.scene, system, embedding);
}

}  // namespace

std::vector<TwoFormulations> cross_checks() {
  return {plane_pendulum(),
          cone(),
          double_pendulum(),
          parabolic_slide(),
          sliding_pivot(),
          sliding_rod(),
          hoop_about_external_axis(),
          hoop_about_diameter(),
          governor(),
          disk_on_rotating_track(),
          driven_pivot(DrivenPivot::horizontal(), "horizontal", "mex248"),
          driven_pivot(DrivenPivot::vertical(), "vertical", "mex249"),
          driven_pivot(DrivenPivot::circular(), "circular", "mex250")};
}

}  // namespace dalembert::models
