#include "dalembert/models/small_motions.h"

#include <dalembert/models/chain.h>
#include <dalembert/models/cone.h>
#include <dalembert/models/disk_on_rotating_track.h>
#include <dalembert/models/double_pendulum.h>
#include <dalembert/models/driven_pivot.h>
#include <dalembert/models/elastic_string_circle.h>
#include <dalembert/models/elastic_string_line.h>
#include <dalembert/models/governor.h>
#include <dalembert/models/hoop_about_diameter.h>
#include <dalembert/models/hoop_about_external_axis.h>
#include <dalembert/models/parabolic_slide.h>
#include <dalembert/models/plane_pendulum.h>
#include <dalembert/models/sliding_pivot.h>
#include <dalembert/models/sliding_rod.h>
#include <dalembert/models/steady_motions.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace dalembert::models {

namespace {

constexpr double g = 9.81;

EquilibriumOptions<3> about_z(double rate) { return {.turning = {.rate = {0.0, 0.0, rate}}}; }

void plane_pendulum(std::vector<Compared>& all) {
  Rows rows(all, "plane-pendulum");
  const PlanePendulum p{.mass = 2.0, .length = 0.7, .amplitude = 1.0};
  const auto built = p.scene();
  const auto rest = equilibrium(built.scene);
  rows.add("height", rest.sample().position(built.beads[0]).y(), -p.length);
  rows.add("tension", -rest.sample().multiplier(built.rods[0]), p.mass * g);
  rows.add("omega", normal_modes(built.scene, rest).frequency(0), std::sqrt(g / p.length));
}

void double_pendulum(std::vector<Compared>& all) {
  Rows rows(all, "double-pendulum");
  const DoublePendulum p{
      .mass1 = 1.0, .mass2 = 3.0, .length1 = 1.0, .length2 = 0.5, .angle1 = 0.4, .angle2 = 0.9};
  const auto built = p.scene();
  const auto rest = equilibrium(built.scene);
  const auto modes = normal_modes(built.scene, rest);
  const double m = p.mass1 + p.mass2, b = m * g * (p.length1 + p.length2),
               a = p.mass1 * p.length1 * p.length2, root = std::sqrt(b * b - 4.0 * a * m * g * g);
  rows.add("upper tension", -rest.sample().multiplier(built.rods[0]), m * g);
  rows.add("lower tension", -rest.sample().multiplier(built.rods[1]), p.mass2 * g);
  rows.add("omega 1", modes.frequency(0), std::sqrt(2.0 * m * g * g / (b + root)));
  rows.add("omega 2", modes.frequency(1), std::sqrt((b + root) / (2.0 * a)));
}

void parabolic_slide(std::vector<Compared>& all) {
  Rows rows(all, "parabolic-slide");
  const ParabolicSlide p{.curvature = 0.5, .amplitude = 0.6};
  const auto built = p.scene();
  const auto rest = equilibrium(built.scene);
  rows.add("x", rest.sample().position(built.bead).x(), 0.0);
  rows.add("normal force", rest.sample().constraint_force(built.bead).y(), p.mass * g);
  rows.add("omega", normal_modes(built.scene, rest).frequency(0), std::sqrt(2.0 * g * p.curvature));
}

void sliding_pivot(std::vector<Compared>& all) {
  Rows rows(all, "sliding-pivot");
  const SlidingPivot p{.angle = 0.9};
  const auto built = p.scene();
  const auto rest = equilibrium(built.scene);
  const auto modes = normal_modes(built.scene, rest);
  rows.add("track force", rest.sample().multiplier(built.track), (p.block_mass + p.bob_mass) * g);
  rows.add("tension", -rest.sample().multiplier(built.rod), p.bob_mass * g);
  rows.add("omega of the free motion", modes.is_free(0) ? modes.frequency(0) : NAN, 0.0);
  rows.add("omega", modes.frequency(1), std::sqrt(g / p.length * (1.0 + p.bob_mass / p.block_mass)));
}

void sliding_rod(std::vector<Compared>& all) {
  Rows rows(all, "sliding-rod");
  const SlidingRod p{.mass = 2.0, .length = 0.8, .angle = 2.5};
  const auto built = p.scene();
  const auto rest = equilibrium(built.scene);
  const auto modes = normal_modes(built.scene, rest);
  rows.add("track force", rest.sample().multiplier(built.track), p.mass * g);
  rows.add("omega of the free motion", modes.is_free(0) ? modes.frequency(0) : NAN, 0.0);
  rows.add("omega", modes.frequency(1), std::sqrt(6.0 * g / p.length));
}

void elastic_strings(std::vector<Compared>& all) {
  Rows line(all, "elastic-string-line");
  const ElasticStringLine on_line{.amplitude = 0.4};
  const BeadOnCurve built = on_line.scene();
  const auto rest = equilibrium(built.scene);
  line.add("force", rest.sample().constraint_force(built.bead).norm(), on_line.stiffness / 2.0);
  line.add("omega", normal_modes(built.scene, rest).frequency(0), std::sqrt(on_line.stiffness / 3.0));
  for (const auto tied : {ElasticStringCircle::Tied::outside, ElasticStringCircle::Tied::inside}) {
    const bool outside = tied == ElasticStringCircle::Tied::outside;
    Rows circle(all, outside ? "elastic-string-circle-outside" : "elastic-string-circle-inside");
    const ElasticStringCircle on_circle{.tied = tied, .angle = 0.4};
    const double d = outside ? on_circle.radius + 1.5 : on_circle.radius - 1.5;
    const BeadOnCurve round = on_circle.scene();
    const auto found = equilibrium(round.scene);
    circle.add("force", found.sample().constraint_force(round.bead).norm(), on_circle.stiffness / 2.0);
    circle.add("omega", normal_modes(round.scene, found).frequency(0),
               std::sqrt(on_circle.stiffness / 3.0 * d / on_circle.radius));
  }
}

void cone(std::vector<Compared>& all) {
  Rows rows(all, "cone");
  const ConeSlide p{.mass = 1.5, .half_angle = 0.6};
  const double Omega = 3.0;
  const auto built = p.scene();
  const auto orbit = equilibrium(built.scene, about_z(Omega));
  const auto modes = normal_modes(built.scene, orbit);
  rows.add("radius", orbit.sample().position(built.particle).head<2>().norm(),
           g / std::tan(p.half_angle) / (Omega * Omega));
  rows.add("normal force", orbit.sample().multiplier(built.wall), p.mass * g / std::sin(p.half_angle));
  rows.add("omega of the free motion", modes.is_free(0) ? modes.frequency(0) : NAN, 0.0);
  rows.add("omega", modes.frequency(1), std::sqrt(3.0) * Omega * std::sin(p.half_angle));
}

void conical_pendulum(std::vector<Compared>& all) {
  Rows rows(all, "conical-pendulum");
  const double m = 2.0, l = 0.8, Omega = 4.5, cosine = g / (l * Omega * Omega);
  Scene<3> scene("conical-pendulum");
  scene.add(UniformGravity<3>{{0.0, 0.0, -g}});
  const auto bob = scene.add_particle({.mass = m, .position = {0.6 * l, 0.0, -0.8 * l}});
  const auto rod = scene.add(Distance{Fixed<3>{}, bob, l});
  const auto orbit = equilibrium(scene, about_z(Omega));
  rows.add("cosine", -orbit.sample().position(bob).z() / l, cosine);
  rows.add("tension", -orbit.sample().multiplier(rod), m * l * Omega * Omega);
  rows.add("omega", normal_modes(scene, orbit).frequency(1), Omega * std::sqrt(1.0 + 3.0 * cosine * cosine));
}

void hoops(std::vector<Compared>& all) {
  for (const double spin : {2.0, 4.5}) {
    Rows rows(all, spin < 3.0 ? "hoop-about-diameter-slow" : "hoop-about-diameter");
    const HoopAboutDiameter p{.mass = 1.5, .spin = spin, .angle = spin < 3.0 ? 0.5 : 1.4};
    const auto built = p.scene();
    const auto turning = equilibrium(built.scene, about_z(spin));
    const double cosine = std::min(1.0, g / (spin * spin)), sine2 = 1.0 - cosine * cosine;
    rows.add("cosine", -turning.sample().position(built.bead).z(), cosine);
    rows.add("force inwards", -turning.sample().multiplier(built.sphere),
             p.mass * (spin * spin * sine2 + g * cosine));
    rows.add("sideways force", turning.sample().multiplier(built.plane), 0.0);
    rows.add("omega", normal_modes(built.scene, turning).frequency(0),
             std::sqrt(spin < 3.0 ? g - spin * spin : spin * spin * sine2));
  }
  Rows rows(all, "hoop-about-external-axis");
  const HoopAboutExternalAxis p{.mass = 1.5, .amplitude = 0.7};
  const auto built = p.scene();
  const auto turning = equilibrium(built.scene, {.turning = {.rate = p.spin}});
  rows.add("force inwards", turning.sample().constraint_force(built.bead).norm(),
           p.mass * (p.radius + p.offset) * p.spin * p.spin);
  rows.add("omega", normal_modes(built.scene, turning).frequency(0), p.spin * std::sqrt(p.offset / p.radius));
}

void governor(std::vector<Compared>& all) {
  Rows rows(all, "governor");
  const Governor p{.mass = 1.0, .sleeve_mass = 2.0, .spin = 7.0};
  const double m1 = p.mass, m2 = p.sleeve_mass, Omega2 = p.spin * p.spin;
  const double cosine = (m1 + m2) * g / (m1 * p.length * Omega2), sine2 = 1.0 - cosine * cosine;
  const auto [scene, parts] = p.scene();
  const auto working = equilibrium(scene, about_z(p.spin));
  rows.add("cosine", -working.sample().position(parts.masses[0]).z() / p.length, cosine);
  rows.add("upper rod", -working.sample().multiplier(parts.upper[0]), (m1 + m2 / 2.0) * g / cosine);
  rows.add("lower rod", -working.sample().multiplier(parts.lower[1]), m2 * g / (2.0 * cosine));
  rows.add("omega", normal_modes(scene, working).frequency(0),
           std::sqrt(m1 * Omega2 * sine2 / (m1 + 2.0 * m2 * sine2)));
}

void disk_on_rotating_track(std::vector<Compared>& all) {
  Rows rows(all, "disk-on-rotating-track");
  const DiskOnRotatingTrack p{.spin = 1.5, .start = 0.4};
  const auto built = p.scene();
  const auto middle = equilibrium(built.scene, {.turning = {.rate = p.spin}});
  const auto modes = normal_modes(built.scene, middle);
  const double growth = -modes.damping(modes.size() - 1);
  rows.add("radius", middle.sample().position(built.centre).norm(), p.radius);
  rows.add("normal force", middle.sample().constraint_force(built.centre).norm(),
           p.mass * p.spin * p.spin * p.radius);
  rows.add("growth", std::abs(growth), p.spin * std::sqrt(2.0 / 3.0));
}

void chain(std::vector<Compared>& all) {
  for (const int N : {2, 5, 20}) {
    Rows rows(all, "chain-" + std::to_string(N));
    const Chain p{.beads = N, .length = 2.0, .mass = 3.0};
    const auto built = p.scene();
    const auto rest = equilibrium(built.scene);
    const auto modes = normal_modes(built.scene, rest);
    const auto zeros = laguerre_zeros(N);
    rows.add("upper tension", -rest.sample().multiplier(built.rods.front()), p.mass * g);
    rows.add("lower tension", -rest.sample().multiplier(built.rods.back()), p.mass * g / N);
    for (std::size_t k = 0; k < zeros.size(); ++k)
      rows.add("omega " + std::to_string(k + 1), modes.frequency(k), std::sqrt(g * N / p.length * zeros[k]));
  }
}

/// Where branches of equilibria meet.
void bifurcations(std::vector<Compared>& all) {
  const auto hoop = follow_branches<3>(
      [](double spin) {
        return Posed<3>{HoopAboutDiameter{.spin = spin, .angle = 0.0}.scene().scene, about_z(spin)};
      },
      {.from = 2.0, .to = 6.0});
  const auto first = [](const auto& diagram) {
    return diagram.bifurcations.size() == 1 ? diagram.bifurcations[0].parameter : NAN;
  };
  Rows(all, "hoop-about-diameter").add("Omega of the pitchfork", first(hoop), std::sqrt(g));
  const Governor p;
  const auto governor = follow_branches<3>(
      [](double spin) {
        return Posed<3>{Governor{.spin = spin, .angle = 0.0}.scene().scene, about_z(spin)};
      },
      {.from = 2.0, .to = 9.0});
  Rows(all, "governor")
      .add("Omega of the threshold", first(governor),
           std::sqrt((p.mass + p.sleeve_mass) * g / (p.mass * p.length)));
}

/// The excess over 2 of the sum of the multipliers of a pendulum upright on a shaken pivot: 0 at the
/// boundary.
double excess(double amplitude, double x) {
  DrivenPivot pivot = DrivenPivot::vertical(amplitude);
  pivot.gravity = x * pivot.frequency * pivot.frequency;
  pivot.angle = std::numbers::pi;
  const auto found = floquet(pivot.scene().scene, 2.0 * std::numbers::pi / pivot.frequency);
  return (found.multipliers[0] + found.multipliers[1]).real() - 2.0;
}

/// Its gravity g/(l omega^2) by the secant method, from Kapitza's A^2/2.
void kapitza(std::vector<Compared>& all) {
  Rows rows(all, "driven-pivot-vertical");
  const double published[] = {0.00124863595013, 0.00497832408961, 0.0196623219494};
  int i = 0;
  for (const double A : {0.05, 0.1, 0.2}) {
    double x0 = A * A / 2.0, x1 = 0.99 * x0, f0 = excess(A, x0), f1 = excess(A, x1);
    while (std::abs(x1 - x0) > 1e-13 && f1 != f0) {
      const double x2 = x1 - f1 * (x1 - x0) / (f1 - f0);
      x0 = std::exchange(x1, x2);
      f0 = std::exchange(f1, excess(A, x2));
    }
    rows.add("Kapitza's g/(l omega^2) at A/l = " + std::to_string(A).substr(0, 4), x1, published[i++], 1e-9);
  }
}

/// L_N(x) by (n + 1) L_(n+1) = (2 n + 1 - x) L_n - n L_(n-1).
long double laguerre(int N, long double x) {
  long double before = 1.0L, now = 1.0L - x;
  for (int n = 1; n < N; ++n) {
    const long double next = ((2 * n + 1 - x) * now - n * before) / (n + 1);
    before = now;
    now = next;
  }
  return N == 0 ? before : now;
}

}  // namespace

double Compared::error() const {
  return std::abs(value - reference) / (reference == 0.0 ? 1.0 : std::abs(reference));
}

/// All zeros lie below 4 N + 2, and neighbours are farther apart than the step: the first is near 1.45/(N +
/// 1/2), the distances grow.
std::vector<double> laguerre_zeros(int N) {
  std::vector<double> zeros;
  const long double step = 0.1L / (N + 0.5L);
  for (long double low = 0.0L; low < 4 * N + 2; low += step) {
    long double a = low, b = low + step;
    if ((laguerre(N, a) > 0.0L) == (laguerre(N, b) > 0.0L)) continue;
    for (int halving = 0; halving < 64; ++halving) {
      const long double middle = (a + b) / 2;
      ((laguerre(N, middle) > 0.0L) == (laguerre(N, a) > 0.0L) ? a : b) = middle;
    }
    zeros.push_back(static_cast<double>(a));
  }
  return zeros;
}

std::vector<SmallMotions> systems_with_small_motions() {
  std::vector<SmallMotions> systems;
  const auto add = [&systems](const char* name, void (*append)(std::vector<Compared>&)) {
    systems.push_back({name, [append] {
                         std::vector<Compared> rows;
                         append(rows);
                         return rows;
                       }});
  };
  add("plane-pendulum", plane_pendulum);
  add("double-pendulum", double_pendulum);
  add("parabolic-slide", parabolic_slide);
  add("sliding-pivot", sliding_pivot);
  add("sliding-rod", sliding_rod);
  add("elastic-strings", elastic_strings);
  add("cone", cone);
  add("conical-pendulum", conical_pendulum);
  add("hoops", hoops);
  add("governor", governor);
  add("disk-on-rotating-track", disk_on_rotating_track);
  add("chain", chain);
  add("bifurcations", bifurcations);
  add("kapitza", kapitza);
  for (const auto& [name, append] : steady_motions()) add(name, append);
  return systems;
}

std::vector<Compared> small_motions() {
  std::vector<Compared> all;
  for (const SmallMotions& system : systems_with_small_motions())
    std::ranges::copy(system.rows(), std::back_inserter(all));
  return all;
}

}  // namespace dalembert::models
