#include "dalembert/core/results/sample.h"

#include <dalembert/core/errors.h>
#include <dalembert/core/results/applied_forces.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace dalembert {

namespace {

std::string at_time(double t) {
  std::ostringstream out;
  out << " at t = " << std::setprecision(10) << t;
  return out.str();
}

}  // namespace

template <int D>
void Sample<D>::refuse_path() const {
  throw EquationFault("The path of a driven point has no finite value or derivative" + at_time(flat_.time) +
                      "; read it at another time");
}

template <int D>
void Sample<D>::refuse_acceleration() const {
  throw UndeterminedForce("This acceleration is not determined" + at_time(flat_.time) +
                          ", because the force of a constraint on it is not; ask for that to read why");
}

template <int D>
double Sample<D>::angle(Rotor rotor) const {
  require_known(rotor);
  return rotor.gather(flat_.q)[0];
}

template <int D>
double Sample<D>::angular_velocity(Rotor rotor) const {
  require_known(rotor);
  return rotor.gather(flat_.v)[0];
}

template <int D>
double Sample<D>::angular_acceleration(Rotor rotor) const {
  require_known(rotor);
  const double a = rotor.gather(flat_.a)[0];
  if (std::isnan(a)) refuse_acceleration();
  return a;
}

template <int D>
bool Sample<D>::unique(const Layout::Constraint& constraint, int component) const {
  if (component < 0 || component >= constraint.rows) {
    throw InvalidArgument(constraint.label() + " has no component " + std::to_string(component) +
                          ": it has " + std::to_string(constraint.rows) + ", counted from 0");
  }
  return flat_.unique.empty() ||
         constraint.own_rows().in(flat_.unique)[static_cast<std::size_t>(component)] != 0;
}

template <int D>
bool Sample<D>::determined(const Layout::Constraint& constraint) const {
  const auto own = constraint.own_rows().in(flat_.lambda);
  return std::ranges::none_of(own, [](double lambda) { return std::isnan(lambda); });
}

template <int D>
void Sample<D>::refuse(const Layout::Constraint& constraint) const {
  throw UndeterminedForce(
      "The force of " + constraint.label() + " is not determined" + at_time(flat_.time) +
      ": the constraints are so close to linearly dependent there that round-off in the state "
      "changes it, or it is so stiff that positions do not tell its deflection; "
      "read it at another time, a stiff spring with Stepper::ida, or ask is_determined before");
}

template <int D>
double Sample<D>::force_at(const Layout::Constraint& constraint, int coordinate) const {
  double Z = 0.0;
  for (const std::size_t slot : constraint.slots())
    if (layout_->slot_coordinate[slot] == coordinate) Z += flat_.forces[slot];
  if (std::isnan(Z)) refuse(constraint);
  return Z;
}

template <int D>
Vec<D> Sample<D>::force_of(const Layout::Constraint& constraint, Particle<D> particle) const {
  require_known(particle);
  Vec<D> Z;
  for (int k = 0; k < D; ++k) Z[k] = force_at(constraint, particle.coordinate + k);
  return Z;
}

/// Of all constraints that act on one coordinate.
template <int D>
double Sample<D>::force_on(int coordinate) const {
  double Z = 0.0;
  for (const int slot : layout_->touching_slots(coordinate))
    Z += flat_.forces[static_cast<std::size_t>(slot)];
  if (!std::isnan(Z)) return Z;
  for (const Layout::Constraint& c : layout_->constraints) (void)force_at(c, coordinate);  // says which
  return Z;
}

template <int D>
Vec<D> Sample<D>::constraint_force(Particle<D> particle) const {
  require_known(particle);
  Vec<D> Z;
  for (int k = 0; k < D; ++k) Z[k] = force_on(particle.coordinate + k);
  return Z;
}

template <int D>
MomentOf<D> Sample<D>::moment(Particle<D> particle, const Vec<D>& force, const Vec<D>& about) const {
  return detail::moment(Vec<D>(position(particle) - about), force);
}

template <int D>
Vec<D> Sample<D>::force_on_ground(const Layout::Constraint& constraint) const {
  Vec<D> Z = Vec<D>::Zero();
  for (const std::size_t slot : constraint.slots()) {
    const int coordinate = layout_->slot_coordinate[slot];
    if (const auto* p = layout_->particle_at(coordinate)) Z[coordinate - p->coordinate] -= flat_.forces[slot];
  }
  if (!Z.allFinite()) refuse(constraint);
  return Z;
}

template <int D>
MomentOf<D> Sample<D>::moment_on_ground(const Layout::Constraint& constraint, const Vec<D>& about) const {
  (void)force_on_ground(constraint);  // is it determined?
  const Vec<D> zero = Vec<D>::Zero();
  MomentOf<D> M = detail::moment(zero, zero);
  for (const std::size_t slot : constraint.slots()) {
    const int coordinate = layout_->slot_coordinate[slot];
    const auto* p = layout_->particle_at(coordinate);
    if (p == nullptr) {
      throw InvalidArgument(
          constraint.label() +
          " turns a rotor, whose axis has no place in space, so that its moment on the ground "
          "is not known; read constraint_torque of the rotor and ground_force");
    }
    const Vec<D> r = Vec<D>::from(flat_.q.data() + p->coordinate) - about;
    M -= detail::moment(r, Vec<D>(flat_.forces[slot] * Vec<D>::Unit(coordinate - p->coordinate)));
  }
  return M;
}

template <int D>
void Sample<D>::evaluate(Force force, int first, double mass, std::span<double> out) const {
  layout_->require(force);
  const auto number = static_cast<std::size_t>(force.index);
  bool determined = false;
  try {
    determined = layout_->applied->on(number, instant(), flat_.lambda, first, mass, out);
  } catch (const ElementFault& fault) {
    throw EquationFault(layout_->forces[number].label() + ' ' + fault.what + at_time(flat_.time));
  }
  if (!determined)
    throw UndeterminedForce(layout_->forces[number].label() + " is not determined" + at_time(flat_.time) +
                            ", because the multiplier that it reads is not; read it at another time");
}

template <int D>
Vec<D> Sample<D>::force(Force force, Particle<D> particle) const {
  require_known(particle);
  Vec<D> F;
  evaluate(force, particle.coordinate, layout_->particles[static_cast<std::size_t>(particle.index)].mass,
           {F.data(), static_cast<std::size_t>(D)});
  return F;
}

template <int D>
double Sample<D>::torque(Force force, Rotor rotor) const {
  require_known(rotor);
  double torque = 0.0;
  evaluate(force, rotor.coordinate, 0.0, {&torque, 1});
  return torque;
}

template class Sample<2>;
template class Sample<3>;

}  // namespace dalembert
