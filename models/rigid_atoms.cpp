#include "dalembert/models/rigid_atoms.h"

#include <dalembert/models/minimal_ode.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace dalembert::models {

namespace {

using Vector = VecOf<Real, 3>;
using Matrix = Eigen::Matrix<Real, 3, 3>;

/// The state is w in body axes, then R column by column.
struct Attitude {
  Vector w;
  Matrix R;
  explicit Attitude(const State& y) : w(Vector::from(y.data())), R(Eigen::Map<const Matrix>(y.data() + 3)) {}
};

/// Euler's equations.
class Top {
 public:
  explicit Top(const Matrix& inertia) : inertia_(inertia), inverse_(inertia.inverse()) {}
  [[nodiscard]] Vector acceleration(const Vector& w) const { return inverse_ * (inertia_ * w).cross(w); }
  void operator()(const State& y, State& y_rate) const {
    const Attitude now(y);
    std::ranges::copy(acceleration(now.w), y_rate.begin());
    for (int k = 0; k < 3; ++k)
      std::ranges::copy(now.R * now.w.cross(Vector::Unit(k)), y_rate.begin() + 3 + 3 * k);
  }

 private:
  Matrix inertia_, inverse_;
};

}  // namespace

template <int D>
BoundAtoms<D> bind(const std::string& name, std::span<const ParticleState<D>> atoms) {
  BoundAtoms<D> built{.scene = Scene<D>(name), .atoms = {}, .bonds = {}};
  for (const ParticleState<D>& atom : atoms) built.atoms.push_back(built.scene.add_particle(atom));
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    for (std::size_t j = i + 1; j < atoms.size(); ++j) {
      const double length = (atoms[j].position - atoms[i].position).norm();
      built.bonds.push_back(built.scene.add(Distance{built.atoms[i], built.atoms[j], length}));
    }
  }
  return built;
}
template BoundAtoms<2> bind(const std::string&, std::span<const ParticleState<2>>);
template BoundAtoms<3> bind(const std::string&, std::span<const ParticleState<3>>);

std::vector<Vec<3>> RigidAtoms::places() const {
  std::vector<Vec<3>> s;
  Vec<3> centre = Vec<3>::Zero();
  for (int k = 0; k < atoms; ++k) {
    const double u = 2.0 * std::numbers::pi * k / atoms;
    s.push_back(semi_axes.cwiseProduct(Vec<3>(std::cos(u), std::sin(u), k % 2 == 0 ? 1.0 : -1.0)));
    centre += s.back() / atoms;
  }
  for (Vec<3>& place : s) place -= centre;
  return s;
}

Mat<3, 3> RigidAtoms::inertia() const {
  Mat<3, 3> I = Mat<3, 3>::Zero();
  for (const Vec<3>& s : places())
    I += mass / atoms * (s.squaredNorm() * Mat<3, 3>::Identity() - s * s.transpose());
  return I;
}

BoundAtoms<3> RigidAtoms::scene() const {
  std::vector<ParticleState<3>> states;
  for (const Vec<3>& s : places()) states.push_back({mass / atoms, s, angular_velocity.cross(s)});
  return bind<3>("rigid-body", states);
}

std::vector<Observation<3>> RigidAtoms::reference(std::span<const double> times) const {
  const Top top(inertia().cast<Real>());
  const std::vector<Vec<3>> in_body = places();
  State start(12, 0);
  std::ranges::copy(angular_velocity, start.begin());
  Eigen::Map<Matrix>(start.data() + 3).setIdentity();
  std::vector<Observation<3>> seen;
  integrate(std::cref(top), start, times, [&](const State& y) {
    const Attitude now(y);
    const Vector w_rate = top.acceleration(now.w);
    Observation<3> at;
    for (const Vec<3>& place : in_body) {
      const Vector s = place.cast<Real>();
      const Vector force = Real(mass) / atoms * (now.R * (w_rate.cross(s) + now.w.cross(now.w.cross(s))));
      at.positions.push_back((now.R * s).cast<double>());
      for (int i = 0; i < 3; ++i) at.forces.push_back(static_cast<double>(force[i]));
    }
    seen.push_back(std::move(at));
  });
  return seen;
}

Observation<3> RigidAtoms::reference(double t) const { return reference(std::array{t}).front(); }

Model<3> RigidAtoms::model() const {
  const double size = semi_axes.maxCoeff(), rate = angular_velocity.norm();
  return {.name = "rigid-body",
          .notes = "mln36",
          .reference = "Euler's equations in extended precision, force on each atom by Newton's law",
          .t_end = 10.0,
          .length = size,
          .force = mass * size * rate * rate,
          .energy = 0.5 * angular_velocity.dot(inertia() * angular_velocity),
          .scene =
              [*this] {
                BoundAtoms<3> built = scene();
                return Observed<3>{std::move(built.scene),
                                   [all = std::move(built.atoms)](const Sample<3>& sample) {
                                     Observation<3> seen;
                                     for (const Particle<3>& atom : all) {
                                       const Vec<3> force = sample.constraint_force(atom);
                                       seen.positions.push_back(sample.position(atom));
                                       for (int i = 0; i < 3; ++i) seen.forces.push_back(force[i]);
                                     }
                                     return seen;
                                   }};
              },
          .observations = [*this](std::span<const double> times) { return reference(times); }};
}

}  // namespace dalembert::models
