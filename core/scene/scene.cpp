#include "dalembert/core/scene/scene.h"

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
  masses_.insert(masses_.end(), D, state.mass);
  extent_.extend(state.position);
  return particle;
}

template <int D>
Rotor Scene<D>::add_rotor(const RotorState& state, const std::string& name) {
  const std::string own = unique_name("rotor", name, layout_.rotors.size());
  const std::string label = "Rotor \"" + own + "\": ";
  const auto require = [&label](bool good, const char* what, double value, const char* rule) {
    std::ostringstream text;
    text << label << what << " = " << value << ", must be finite" << rule;
    if (!good) throw InvalidScene(text.str());
  };
  require(std::isfinite(state.inertia) && state.inertia > 0.0, "inertia", state.inertia, " and > 0");
  require(std::isfinite(state.angle), "angle", state.angle, "");
  require(std::isfinite(state.angular_velocity), "angular_velocity", state.angular_velocity, "");
  const Rotor rotor{static_cast<int>(layout_.rotors.size()), static_cast<int>(q_.size()), layout_.id};
  layout_.rotors.push_back({own, rotor.coordinate, state.inertia});
  q_.push_back(state.angle);
  v_.push_back(state.angular_velocity);
  masses_.push_back(state.inertia);
  return rotor;
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
void Scene<D>::require_own(std::uint64_t scene, int coordinate, const std::string& label) const {
  if (scene == layout_.id && coordinate >= 0 && coordinate < static_cast<int>(q_.size())) return;
  throw InvalidScene(label + ": a particle or rotor it acts on " +
                     (scene == 0 ? "was never added" : "belongs to another scene") +
                     "; use the handle that add_particle or add_rotor of scene \"" + layout_.scene +
                     "\" returned");
}

template <int D>
void Scene<D>::require_constraint(std::uint64_t scene, int index, int rows, const std::string& label) const {
  if (scene == layout_.id && index >= 0 && index < static_cast<int>(layout_.constraints.size()) &&
      layout_.constraints[static_cast<std::size_t>(index)].rows == rows)
    return;
  throw InvalidScene(label + ": the constraint whose multiplier it reads " +
                     (scene == 0 || scene == layout_.id ? "was never added" : "belongs to another scene") +
                     "; use the handle that add of scene \"" + layout_.scene + "\" returned");
}

template <int D>
void Scene<D>::admit_fixed(const Vec<D>& fixed, const std::string& label,
                           Eigen::AlignedBox<double, D>& extent) {
  if (!fixed.allFinite()) {
    throw InvalidScene(label + ": its fixed point " + text<D>(fixed) + " must be finite");
  }
  extent.extend(fixed);
}

template <int D>
void Scene<D>::require_compliance(double compliance, const std::string& label) {
  if (std::isfinite(compliance) && compliance >= 0.0) return;
  std::ostringstream what;
  what << label << ": compliance = " << compliance << ", must be finite and >= 0; 0 is rigid";
  throw InvalidScene(what.str());
}

template <int D>
void Scene<D>::take(const std::string& name, const Eigen::AlignedBox<double, D>& extent) {
  names_.insert(name);
  extent_ = extent;
}

template <int D>
ConstraintBatch& Scene<D>::begin_group(std::unique_ptr<ConstraintBatch> batch) {
  return *constraints_.emplace_back(ConstraintGroup{std::move(batch), {}}).batch;
}

template <int D>
int Scene<D>::enter(std::size_t group, const std::string& name) {
  const int number = static_cast<int>(layout_.constraints.size());
  const ConstraintShape shape = constraints_[group].batch->shape();
  layout_.constraints.push_back(
      {std::string(shape.kind), name, shape.rows, shape.width, shape.inputs, shape.internal, 0, 0});
  constraints_[group].numbers.push_back(number);
  return number;
}

template <int D>
System Scene<D>::system() const {
  if (q_.empty()) {
    throw InvalidScene("Scene \"" + layout_.scene + "\" is empty: add at least one particle");
  }
  // A path that has no value at the start is refused there, by the constraint that needs it.
  const auto extent = [box = extent_, paths = paths_](double t) {
    auto with_paths = box;
    for (const auto& path : paths) {
      try {
        if (const Vec<D> r = path(t); r.allFinite()) with_paths.extend(r);
      } catch (...) {
      }
    }
    return with_paths.isEmpty() ? 0.0 : with_paths.diagonal().norm();
  };
  SystemParts parts{layout_, masses_, std::vector<double>(q_.size(), 0.0), {}, {}, {}, {}, extent};
  for (const auto& particle : layout_.particles) {
    for (int k = 0; k < D; ++k) {
      parts.constant_force[static_cast<std::size_t>(particle.coordinate + k)] = particle.mass * gravity_[k];
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
  for (const auto& group : frictions_) {
    parts.frictions.push_back(group.batch->clone());
    parts.friction_names.push_back(group.names);
  }
  return System(std::move(parts));
}

template class Scene<2>;
template class Scene<3>;

}  // namespace dalembert
