#include <dalembert/core/errors.h>
#include <dalembert/core/scene/scene.h>

#include <algorithm>
#include <array>
#include <limits>

namespace dalembert {

template <int D>
void Scene<D>::require_state(const Sample<D>& sample) const {
  const Layout& its = sample.layout();
  const auto same = [](const auto& a, const auto& b) {
    return a.scene == b.scene && a.coordinate == b.coordinate;
  };
  if (std::ranges::equal(layout_.particles, its.particles, same) &&
      std::ranges::equal(layout_.rotors, its.rotors, same))
    return;
  throw InvalidArgument(
      "Scene \"" + layout_.scene + "\" cannot start from a sample of scene \"" + its.scene +
      "\": its particles and rotors differ; take a sample of a run of this scene or of a copy");
}

template <int D>
void Scene<D>::start_from(const Sample<D>& sample) {
  require_state(sample);
  q_.assign(sample.flat().q.begin(), sample.flat().q.end());
  v_.assign(sample.flat().v.begin(), sample.flat().v.end());
}

template <int D>
void Scene<D>::set_released(int constraint, bool released) {
  const auto number = static_cast<std::size_t>(constraint);
  Condition& holds = conditions_.of[number];
  if (holds.contact || holds.roughness)
    throw InvalidArgument(layout_.constraints[number].label() +
                          " does not always hold: it cannot be released or imposed");
  holds.released = released;
}

namespace detail {
/// The least box, along the axes of space, around some points.
template <int D>
struct Box {
  Vec<D> low = Vec<D>::Constant(std::numeric_limits<double>::infinity()), high = -low;

  void extend(const Vec<D>& r) {
    for (int k = 0; k < D; ++k) {
      low[k] = std::min(low[k], r[k]);
      high[k] = std::max(high[k], r[k]);
    }
  }
  /// 0 of no points.
  [[nodiscard]] double diagonal() const { return low.x() > high.x() ? 0.0 : (high - low).norm(); }
};
}  // namespace detail

template <int D>
System Scene<D>::system() const {
  if (q_.empty()) {
    throw InvalidScene("Scene \"" + layout_.scene + "\" is empty: add at least one particle");
  }
  detail::Box<D> box;
  std::vector<Path> paths;
  for (const auto* places : {&constraint_places_, &force_places_}) {
    for (const Place& place : *places) {
      for (const Vec<D>& point : place.around.fixed) box.extend(point);
      paths.insert(paths.end(), place.around.paths.begin(), place.around.paths.end());
    }
  }
  for (const auto& p : layout_.particles) box.extend(Vec<D>::from(q_.data() + p.coordinate));
  // A path that has no value at the start is rejected there, by the constraint that needs it.
  const auto extent = [box, paths = std::move(paths)](double t) {
    auto with_paths = box;
    for (const auto& path : paths) {
      try {
        if (const Vec<D> r = path(t); r.allFinite()) with_paths.extend(r);
      } catch (...) {
      }
    }
    return with_paths.diagonal();
  };
  SystemParts parts{.layout = layout_, .conditions = conditions_, .masses = masses_, .extent = extent};
  parts.layout.id = identity_.number();
  Vec<D> together = Vec<D>::Zero();
  for (const auto& [number, gravity] : gravities_) {
    together += gravity.acceleration;
    std::array<double, 3> g{};
    std::ranges::copy(gravity.acceleration, g.begin());
    parts.forces.gravities.push_back({number, g});
  }
  parts.forces.constant.resize(q_.size());
  for (const auto& particle : layout_.particles) {
    for (int k = 0; k < D; ++k)
      parts.forces.constant[static_cast<std::size_t>(particle.coordinate + k)] = particle.mass * together[k];
  }
  for (const auto& group : constraints_) {
    parts.constraints.push_back(group.batch->clone());
    parts.constraint_numbers.push_back(group.numbers);
  }
  for (const auto& group : forces_) {
    parts.forces.batches.push_back(group.batch->clone());
    parts.forces.numbers.push_back(group.numbers);
  }
  System all(std::move(parts));
  const auto released = all.conditions().released();
  return released.empty() ? all : all.without(released);
}

template void Scene<2>::start_from(const Sample<2>&);
template void Scene<3>::start_from(const Sample<3>&);
template void Scene<2>::set_released(int, bool);
template void Scene<3>::set_released(int, bool);
template void Scene<2>::require_state(const Sample<2>&) const;
template void Scene<3>::require_state(const Sample<3>&) const;
template System Scene<2>::system() const;
template System Scene<3>::system() const;

}  // namespace dalembert
