#include "dalembert/core/scene/scene.h"

#include <array>
#include <atomic>
#include <cmath>
#include <sstream>

namespace dalembert {

std::uint64_t detail::Identity::next() noexcept {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

namespace {

template <int D>
std::string text(const Vec<D>& r) {
  std::ostringstream out;
  for (int k = 0; k < D; ++k) out << (k == 0 ? "(" : ", ") << r[k];
  out << ')';
  return out.str();
}

void require(bool good, const auto& label, const char* what, double value, const char* rule) {
  if (good) return;
  std::ostringstream text;
  text << label.text() << ": " << what << " = " << value << ", must be finite" << rule;
  throw InvalidScene(text.str());
}

}  // namespace

template <int D>
Scene<D>::Scene(std::string name) {
  layout_.scene = std::move(name);
  layout_.dimension = D;
}
template <int D>
Scene<D>::~Scene() = default;
template <int D>
Scene<D>::Scene(const Scene&) = default;
template <int D>
Scene<D>::Scene(Scene&&) noexcept = default;
template <int D>
Scene<D>& Scene<D>::operator=(const Scene&) = default;
template <int D>
Scene<D>& Scene<D>::operator=(Scene&&) noexcept = default;

template <int D>
std::string Scene<D>::Label::text() const {
  return std::string(kind) + " \"" + std::string(name) + '"';
}

template <int D>
void Scene<D>::require_free(std::string_view kind, const std::string& name) const {
  if (!names_.contains(name)) return;
  throw InvalidScene(Label{kind, name}.text() + ": this name is taken in scene \"" + layout_.scene +
                     "\"; names must differ");
}

template <int D>
std::string Scene<D>::unique_name(std::string_view kind, const std::string& name, std::size_t number) const {
  if (name.empty()) {
    std::string own = std::string(kind) + std::to_string(number);
    while (names_.contains(own)) own = std::string(kind) + std::to_string(++number);
    return own;
  }
  require_free(kind, name);
  return name;
}

template <int D>
int Scene<D>::find(std::string_view name, Kind kind) const {
  static constexpr std::array kinds{"particle", "rotor", "constraint", "force"};
  const auto what = [](Kind k) { return kinds[static_cast<std::size_t>(k)]; };
  const auto found = names_.find(std::string(name));
  if (found != names_.end() && found->second.kind == kind) return found->second.index;
  throw InvalidArgument("Scene \"" + layout_.scene + "\" has no " + what(kind) + " \"" + std::string(name) +
                        '"' +
                        (found == names_.end() ? std::string("; use a name that was given when it was added")
                                               : std::string(": that is a ") + what(found->second.kind)));
}

template <int D>
Particle<D> Scene<D>::particle(std::string_view name) const {
  const int index = find(name, Kind::particle);
  const Layout::Particle& its = layout_.particles[static_cast<std::size_t>(index)];
  return {index, its.coordinate, its.scene};
}

template <int D>
Rotor Scene<D>::rotor(std::string_view name) const {
  const int index = find(name, Kind::rotor);
  const Layout::Rotor& its = layout_.rotors[static_cast<std::size_t>(index)];
  return {index, its.coordinate, its.scene};
}

template <int D>
Force Scene<D>::force(std::string_view name) const {
  const int index = find(name, Kind::force);
  return {index, layout_.forces[static_cast<std::size_t>(index)].scene};
}

template <int D>
int Scene<D>::find_constraint(std::string_view name, int rows) const {
  const int index = find(name, Kind::constraint);
  const Layout::Constraint& its = layout_.constraints[static_cast<std::size_t>(index)];
  if (its.rows == rows) return index;
  const std::string n = std::to_string(its.rows);
  throw InvalidArgument(its.label() + " has " + n + " equations, not " + std::to_string(rows) +
                        ": ask for constraint<" + n + ">");
}

template <int D>
void Scene<D>::check(const ParticleState<D>& state, const Label& label) {
  require(std::isnormal(state.mass) && state.mass > 0.0, label, "mass", state.mass,
          " and > 0, above 2.2e-308; for a point without mass use Fixed or driven");
  if (!state.position.allFinite())
    throw InvalidScene(label.text() + ": position = " + text<D>(state.position) + ", must be finite");
  if (!state.velocity.allFinite())
    throw InvalidScene(label.text() + ": velocity = " + text<D>(state.velocity) + ", must be finite");
}

template <int D>
Particle<D> Scene<D>::add_particle(const ParticleState<D>& state, const std::string& name) {
  const int index = static_cast<int>(layout_.particles.size());
  const std::string own = unique_name("particle", name, layout_.particles.size());
  check(state, {"Particle", own});
  const Particle<D> particle{index, static_cast<int>(q_.size()), identity_.number()};
  names_.insert({own, {Kind::particle, index}});
  layout_.particles.push_back({own, particle.coordinate, state.mass, particle.scene});
  q_.insert(q_.end(), state.position.begin(), state.position.end());
  v_.insert(v_.end(), state.velocity.begin(), state.velocity.end());
  masses_.insert(masses_.end(), D, state.mass);
  return particle;
}

template <int D>
void Scene<D>::replace(Particle<D> particle, const ParticleState<D>& state) {
  layout_.require(particle);
  Layout::Particle& its = layout_.particles[static_cast<std::size_t>(particle.index)];
  check(state, {"Particle", its.name});
  its.mass = state.mass;
  for (int k = 0; k < D; ++k) {
    const auto i = static_cast<std::size_t>(particle.coordinate + k);
    q_[i] = state.position[k];
    v_[i] = state.velocity[k];
    masses_[i] = state.mass;
  }
}

template <int D>
void Scene<D>::check(const RotorState& state, const Label& label) {
  require(std::isnormal(state.inertia) && state.inertia > 0.0, label, "inertia", state.inertia,
          " and > 0, above 2.2e-308");
  require(std::isfinite(state.angle), label, "angle", state.angle, "");
  require(std::isfinite(state.angular_velocity), label, "angular_velocity", state.angular_velocity, "");
}

template <int D>
Rotor Scene<D>::add_rotor(const RotorState& state, const std::string& name) {
  const int index = static_cast<int>(layout_.rotors.size());
  const std::string own = unique_name("rotor", name, layout_.rotors.size());
  check(state, {"Rotor", own});
  const Rotor rotor{index, static_cast<int>(q_.size()), identity_.number()};
  names_.insert({own, {Kind::rotor, index}});
  layout_.rotors.push_back({own, rotor.coordinate, state.inertia, rotor.scene});
  q_.push_back(state.angle);
  v_.push_back(state.angular_velocity);
  masses_.push_back(state.inertia);
  return rotor;
}

template <int D>
void Scene<D>::replace(Rotor rotor, const RotorState& state) {
  layout_.require(rotor);
  Layout::Rotor& its = layout_.rotors[static_cast<std::size_t>(rotor.index)];
  check(state, {"Rotor", its.name});
  const auto i = static_cast<std::size_t>(rotor.coordinate);
  its.inertia = masses_[i] = state.inertia;
  q_[i] = state.angle;
  v_[i] = state.angular_velocity;
}

template <int D>
void Scene<D>::check(const UniformGravity<D>& gravity) {
  if (gravity.acceleration.allFinite()) return;
  throw InvalidScene("UniformGravity: acceleration = " + text<D>(gravity.acceleration) + ", must be finite");
}

template <int D>
Force Scene<D>::add(const UniformGravity<D>& gravity, const std::string& name) {
  check(gravity);
  const std::string own = unique_name("UniformGravity", name, gravities_.size());
  const Force force = enter_force({no_group, gravities_.size()}, "UniformGravity", own, {}, nullptr);
  gravities_.push_back({force.index, gravity});
  return force;
}

template <int D>
void Scene<D>::replace(Force handle, const UniformGravity<D>& gravity) {
  layout_.require(handle);
  check(gravity);
  const auto number = static_cast<std::size_t>(handle.index);
  if (force_places_[number].group != no_group) refuse_type(layout_.forces[number].label());
  gravities_[force_places_[number].element].second = gravity;
}

template <int D>
void Scene<D>::refuse_point(std::uint64_t scene, const Label& label) const {
  throw InvalidArgument(label.text() + ": a particle or rotor it acts on " +
                        (scene == 0 ? "was never added" : "belongs to another scene") +
                        "; use the handle that add_particle or add_rotor of scene \"" + layout_.scene +
                        "\" returned");
}

template <int D>
void Scene<D>::refuse_constraint(std::uint64_t scene, const Label& label) const {
  throw InvalidArgument(
      label.text() + ": the constraint whose multiplier it reads " +
      (scene == 0 || scene == identity_.number() ? "was never added" : "belongs to another scene") +
      "; use the handle that add of scene \"" + layout_.scene + "\" returned");
}

template <int D>
void Scene<D>::refuse_type(const std::string& label) {
  throw InvalidArgument(
      label + ": it can be replaced only by one of its own type, on points of the same kinds, with " +
      "other parameters; for another, build another scene");
}

template <int D>
void Scene<D>::admit_fixed(const Vec<D>& fixed, const Label& label) {
  if (!fixed.allFinite()) {
    throw InvalidScene(label.text() + ": its fixed point " + text<D>(fixed) + " must be finite");
  }
}

template <int D>
void Scene<D>::require_compliance(double compliance, const Label& label) {
  if (std::isfinite(compliance) && compliance >= 0.0) return;
  std::ostringstream what;
  what << label.text() << ": compliance = " << compliance << ", must be finite and >= 0; 0 is rigid";
  throw InvalidScene(what.str());
}

template <int D>
class Scene<D>::Admitting final : public detail::Admission {
 public:
  Admitting(const Scene& scene, const Label& label) : scene_(scene), label_(label) {}

  void fault(const std::string& of_parameters) override {
    if (!of_parameters.empty()) throw InvalidScene(label_.text() + ": " + of_parameters);
  }
  void compliance(double value) override { require_compliance(value, label_); }
  void reads(int constraint, std::uint64_t scene, int rows) override {
    if (!scene_.layout_.has_constraint(constraint, scene, rows)) scene_.refuse_constraint(scene, label_);
  }
  void moves(const Particle<2>& point) override { require_own(point); }
  void moves(const Particle<3>& point) override { require_own(point); }
  void moves(const Rotor& point) override { require_own(point); }
  // Those of the other dimension: the compiler has refused an element with such points.
  void stands(const Vec<2>& point) override { keep(point); }
  void stands(const Vec<3>& point) override { keep(point); }
  void follows(std::function<Vec<2>(double)> path) override { keep(std::move(path)); }
  void follows(std::function<Vec<3>(double)> path) override { keep(std::move(path)); }

  [[nodiscard]] Surroundings of(const auto& type, const void* element) && {
    type.tell(element, *this);
    return std::move(around_);
  }

 private:
  void require_own(const auto& point) const {
    if (!scene_.layout_.has(point)) scene_.refuse_point(point.scene, label_);
  }
  void keep(const Vec<D>& point) {
    admit_fixed(point, label_);
    around_.fixed.push_back(point);
  }
  void keep(Path&& path) { around_.paths.push_back(std::move(path)); }
  void keep(const auto& /*of_the_other_dimension*/) {}

  const Scene& scene_;
  const Label& label_;
  Surroundings around_;
};

template <int D>
int Scene<D>::add_any(const detail::ElementTable<ConstraintBatch>& type, const void* constraint,
                      const std::string& name) {
  const std::string own = unique_name(type.kind, name, layout_.constraints.size());
  Surroundings around = Admitting(*this, {type.kind, own}).of(type, constraint);
  const Condition condition = type.condition(constraint);
  auto drawing = type.drawing(constraint);  // copies what a user's lambda captures: may fail
  const Place place = put(constraints_, type, constraint, layout_.constraints.size());
  return enter(place, own, std::move(around), condition, type.meaning, std::move(drawing));
}

template <int D>
Force Scene<D>::add_any(const detail::ElementTable<ForceBatch>& type, const void* force,
                        const std::string& name) {
  const std::string own = unique_name(type.kind, name, layout_.forces.size() - gravities_.size());
  Surroundings around = Admitting(*this, {type.kind, own}).of(type, force);
  auto drawing = type.drawing(force);
  const Place place = put(forces_, type, force, layout_.forces.size());
  return enter_force(place, type.kind, own, std::move(around), std::move(drawing));
}

template <int D>
void Scene<D>::replace_any(int handle, const detail::ElementTable<ConstraintBatch>& type,
                           const void* constraint) {
  const auto number = static_cast<std::size_t>(handle);
  Layout::Constraint& its = layout_.constraints[number];
  Condition& holds = conditions_.of[number];
  Surroundings around = Admitting(*this, {its.kind, its.name}).of(type, constraint);
  Condition condition = type.condition(constraint);
  condition.released = holds.released;
  auto drawing = type.drawing(constraint);
  exchange(constraints_, type, constraint, constraint_places_[number], number, its.label(),
           std::move(around));
  holds = condition;
  its.drawing = std::move(drawing);
}

template <int D>
void Scene<D>::replace_any(int handle, const detail::ElementTable<ForceBatch>& type, const void* force) {
  const auto number = static_cast<std::size_t>(handle);
  Layout::Force& its = layout_.forces[number];
  Surroundings around = Admitting(*this, {its.kind, its.name}).of(type, force);
  auto drawing = type.drawing(force);
  exchange(forces_, type, force, force_places_[number], number, its.label(), std::move(around));
  its.drawing = std::move(drawing);
}

template <int D>
template <class Batch>
typename Scene<D>::Place Scene<D>::put(std::vector<Group<Batch>>& groups,
                                       const detail::ElementTable<Batch>& type, const void* element,
                                       std::size_t number) {
  std::size_t g = 0;
  while (g < groups.size() && !type.add(*groups[g].batch, element)) ++g;
  if (g == groups.size()) {
    groups.push_back({detail::Owned<Batch>(type.empty()), {}});
    type.add(*groups[g].batch, element);
  }
  groups[g].numbers.push_back(static_cast<int>(number));
  return {g, groups[g].numbers.size() - 1};
}

template <int D>
template <class Batch>
void Scene<D>::exchange(std::vector<Group<Batch>>& groups, const detail::ElementTable<Batch>& type,
                        const void* element, Place& place, std::size_t number, const std::string& label,
                        Surroundings around) {
  const bool among_them = place.group < groups.size() && place.element < groups[place.group].numbers.size() &&
                          groups[place.group].numbers[place.element] == static_cast<int>(number);
  if (!among_them || !type.replace(*groups[place.group].batch, place.element, element)) refuse_type(label);
  place.around = std::move(around);
}

template <int D>
int Scene<D>::enter(Place place, const std::string& name, Surroundings around, const Condition& holds,
                    std::string_view meaning, std::shared_ptr<const Drawing> drawing) {
  const int number = static_cast<int>(layout_.constraints.size());
  const ConstraintShape shape = constraints_[place.group].batch->shape();
  layout_.constraints.push_back({std::string(shape.kind), name, shape.rows, shape.width, shape.inputs,
                                 shape.internal, 0, 0, identity_.number(), std::string(meaning),
                                 std::move(drawing)});
  conditions_.of.push_back(holds);
  place.around = std::move(around);
  constraint_places_.push_back(std::move(place));
  names_.insert({name, {Kind::constraint, number}});
  return number;
}

template <int D>
Force Scene<D>::enter_force(Place place, std::string_view kind, const std::string& name, Surroundings around,
                            std::shared_ptr<const Drawing> drawing) {
  const int number = static_cast<int>(layout_.forces.size());
  layout_.forces.push_back({std::string(kind), name, identity_.number(), std::move(drawing)});
  place.around = std::move(around);
  force_places_.push_back(std::move(place));
  names_.insert({name, {Kind::force, number}});
  return {number, identity_.number()};
}

template class Scene<2>;
template class Scene<3>;

}  // namespace dalembert
