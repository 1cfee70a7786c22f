#include "dalembert/core/sample.h"

#include <dalembert/core/errors.h>

namespace dalembert {

namespace {

void require_known(bool same_scene, bool exists, const char* what, const Layout& layout) {
  if (same_scene && exists) return;
  throw InvalidScene(
      std::string("This ") + what + " handle is not one of scene \"" + layout.scene + "\": " +
      (same_scene ? "it was added after the run was made" : "it belongs to another scene or to none") +
      "; use the handles that add_particle and add of this scene returned");
}

}  // namespace

template <int D>
const Layout::Constraint& Sample<D>::info(int index, std::uint64_t scene) const {
  require_known(scene == layout_->id, index >= 0 && index < static_cast<int>(layout_->constraints.size()),
                "constraint", *layout_);
  return layout_->constraints[static_cast<std::size_t>(index)];
}

template <int D>
Vec<D> Sample<D>::position(Particle<D> particle) const {
  require_known(particle.scene == layout_->id,
                particle.index >= 0 && particle.index < static_cast<int>(layout_->particles.size()),
                "particle", *layout_);
  return particle.gather(flat_.q);
}

template <int D>
Vec<D> Sample<D>::velocity(Particle<D> particle) const {
  (void)position(particle);
  return particle.gather(flat_.v);
}

template <int D>
Vec<D> Sample<D>::force_of(const Layout::Constraint& constraint, Particle<D> particle) const {
  (void)position(particle);
  Vec<D> Z = Vec<D>::Zero();
  for (int slot = constraint.first_slot; slot < constraint.first_slot + constraint.width; ++slot) {
    const int component = layout_->slot_coordinate[static_cast<std::size_t>(slot)] - particle.coordinate;
    if (component >= 0 && component < D) Z[component] += flat_.forces[static_cast<std::size_t>(slot)];
  }
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
