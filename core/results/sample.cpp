#include "dalembert/core/results/sample.h"

#include <dalembert/core/errors.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace dalembert {

namespace {

void require_known_handle(bool same_scene, bool exists, const char* what, const Layout& layout) {
  if (same_scene && exists) return;
  throw InvalidScene(
      std::string("This ") + what + " handle is not one of scene \"" + layout.scene + "\": " +
      (same_scene ? "it was added after the run was made" : "it belongs to another scene or to none") +
      "; use the handles that add_particle and add of this scene returned");
}

}  // namespace

template <int D>
const Layout::Constraint& Sample<D>::info(int index, std::uint64_t scene) const {
  require_known_handle(scene == layout_->id,
                       index >= 0 && index < static_cast<int>(layout_->constraints.size()), "constraint",
                       *layout_);
  return layout_->constraints[static_cast<std::size_t>(index)];
}

template <int D>
void Sample<D>::require_coordinate(std::uint64_t scene, int coordinate) const {
  require_known_handle(scene == layout_->id, coordinate >= 0 && coordinate < static_cast<int>(flat_.q.size()),
                       "particle or rotor", *layout_);
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
bool Sample<D>::unique(const Layout::Constraint& constraint, int component) const {
  if (component < 0 || component >= constraint.rows) {
    throw InvalidScene(constraint.label() + " has no component " + std::to_string(component) + ": it has " +
                       std::to_string(constraint.rows) + ", counted from 0");
  }
  return flat_.unique.empty() ||
         flat_.unique[static_cast<std::size_t>(constraint.first_row + component)] != 0;
}

template <int D>
bool Sample<D>::determined(const Layout::Constraint& constraint) const {
  const auto own = flat_.lambda.subspan(static_cast<std::size_t>(constraint.first_row),
                                        static_cast<std::size_t>(constraint.rows));
  return std::ranges::none_of(own, [](double lambda) { return std::isnan(lambda); });
}

template <int D>
void Sample<D>::refuse(const Layout::Constraint& constraint) const {
  std::ostringstream what;
  what << "The force of " << constraint.label() << " is not determined at t = " << std::setprecision(10)
       << flat_.time
       << ": the constraints are so close to dependent there that an error of the state, however small, "
          "changes it; "
          "read it at another time, or ask is_determined before";
  throw UndeterminedForce(what.str());
}

template <int D>
double Sample<D>::force_at(const Layout::Constraint& constraint, int coordinate) const {
  double Z = 0.0;
  for (int slot = constraint.first_slot; slot < constraint.first_slot + constraint.width; ++slot) {
    const auto s = static_cast<std::size_t>(slot);
    if (layout_->slot_coordinate[s] == coordinate) Z += flat_.forces[s];
  }
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

template <int D>
Vec<D> Sample<D>::constraint_force(Particle<D> particle) const {
  Vec<D> Z = Vec<D>::Zero();
  for (const Layout::Constraint& constraint : layout_->constraints) Z += force_of(constraint, particle);
  return Z;
}

template class Sample<2>;
template class Sample<3>;

}  // namespace dalembert
