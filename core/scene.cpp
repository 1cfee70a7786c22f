#include "dalembert/core/scene.h"

#include <atomic>
#include <cmath>
#include <sstream>

namespace dalembert {

namespace {

/// A number no other scene of this process has. It identifies and computes nothing.
std::uint64_t new_identity() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

template <int D>
std::string text(const Vec<D>& r) {
  std::ostringstream out;
  out << '(' << r.transpose().format(Eigen::IOFormat(Eigen::StreamPrecision, Eigen::DontAlignCols, ", "))
      << ')';
  return out.str();
}

}  // namespace

template <int D>
Scene<D>::Scene(std::string name) {
  layout_.scene = std::move(name);
  layout_.id = new_identity();
  layout_.dimension = D;
}

template <int D>
std::string Scene<D>::unique_name(std::string_view kind, const std::string& name, std::size_t number) const {
  if (name.empty()) {
    std::string own = std::string(kind) + std::to_string(number);
    while (names_.contains(own)) own = std::string(kind) + std::to_string(++number);
    return own;
  }
  if (names_.contains(name)) {
    throw InvalidScene(std::string(kind) + " \"" + name + "\": this name is taken in scene \"" +
                       layout_.scene + "\"; names must differ");
  }
  return name;
}

template <int D>
Particle<D> Scene<D>::add_particle(const ParticleState<D>& state, const std::string& name) {
  const std::size_t number = layout_.particles.size();
  const std::string own = unique_name("particle", name, number);
  const std::string label = "Particle \"" + own + "\": ";
  if (!(std::isfinite(state.mass) && state.mass > 0.0)) {
    std::ostringstream mass;
    mass << state.mass;
    throw InvalidScene(label + "mass = " + mass.str() +
                       ", must be finite and > 0; for a point without mass use Fixed or driven");
  }
  if (!state.position.allFinite()) {
    throw InvalidScene(label + "position = " + text<D>(state.position) + ", must be finite");
  }
  if (!state.velocity.allFinite()) {
    throw InvalidScene(label + "velocity = " + text<D>(state.velocity) + ", must be finite");
  }
  names_.insert(own);
  const Particle<D> particle{static_cast<int>(number), static_cast<int>(q_.size()), layout_.id};
  layout_.particles.push_back({own, particle.coordinate, state.mass});
  q_.insert(q_.end(), state.position.begin(), state.position.end());
  v_.insert(v_.end(), state.velocity.begin(), state.velocity.end());
  extent_.extend(state.position);
  return particle;
}

template <int D>
void Scene<D>::add(const UniformGravity<D>& gravity) {
  if (!gravity.acceleration.allFinite()) {
    throw InvalidScene("UniformGravity: acceleration = " + text<D>(gravity.acceleration) +
                       ", must be finite");
  }
  gravity_ += gravity.acceleration;
}

template <int D>
void Scene<D>::require_own(const Particle<D>& particle, const std::string& label) const {
  if (particle.scene == layout_.id && particle.index >= 0 &&
      particle.index < static_cast<int>(layout_.particles.size())) {
    return;
  }
  throw InvalidScene(label + ": a particle it acts on " +
                     (particle.scene == 0 ? "was never added" : "belongs to another scene") +
                     "; use the handle that add_particle of scene \"" + layout_.scene + "\" returned");
}

template <int D>
void Scene<D>::require_finite(const Vec<D>& fixed, const std::string& label) {
  if (!fixed.allFinite()) {
    throw InvalidScene(label + ": its fixed point " + text<D>(fixed) + " must be finite");
  }
}

template <int D>
System Scene<D>::system() const {
  if (layout_.particles.empty()) {
    throw InvalidScene("Scene \"" + layout_.scene + "\" is empty: add at least one particle");
  }
  SystemParts parts{layout_, {}, {}, {}, {}, {}, {}, extent_.diagonal().norm()};
  for (const auto& particle : layout_.particles) {
    for (int k = 0; k < D; ++k) {
      parts.masses.push_back(particle.mass);
      parts.constant_force.push_back(particle.mass * gravity_[k]);
    }
  }
  for (const auto& group : constraints_) {
    parts.constraints.push_back(group.batch->clone());
    parts.constraint_numbers.push_back(group.numbers);
  }
  for (const auto& group : forces_) {
    parts.forces.push_back(group.batch->clone());
    parts.force_names.push_back(group.names);
  }
  return System(std::move(parts));
}

template class Scene<2>;
template class Scene<3>;

}  // namespace dalembert
