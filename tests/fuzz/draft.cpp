#include "draft.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace dalembert::fuzz {

std::string write(double value) {
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  out << value;
  return out.str();
}

template <int D>
Draft<D>::Draft(const Random& r, const Plan& p, const Statement& statement)
    : random(r), plan(p), start_(r), statement_(statement) {
  stranger_ = foreign_.add_particle({.mass = 1.0});
  if (random.chance(0.2)) {
    const double distance = plan.length * random.decades(0.0, 4.0);
    origin_ = distance * random.direction<D>();
  }
}

template <int D>
Fuse Draft<D>::fuse() {
  if (plan.kind != Plan::Kind::invalid || !random.chance(0.3)) return {};
  const Options& o = plan.options;
  return {static_cast<Fuse::Kind>(1 + random.below(4)),
          o.t_start + (o.t_end - o.t_start) * random.between(-0.1, 1.1)};
}

template <int D>
void Draft<D>::attempt(const std::string& text, const std::function<void()>& f) {
  log_ += text;
  try {
    f();
  } catch (const Error& error) {
    log_ += "   -- refused: " + std::string(error.what());
    if (plan.kind == Plan::Kind::sensible || std::string(error.what()).empty())
      refused_ += text + ": " + error.what() + '\n';
  }
  log_ += '\n';
}

template <int D>
Place<D> Draft<D>::new_particle(const Vec<D>& r) {
  ParticleState<D> state;
  state.mass = size(plan.mass);
  state.position = numbers(r);
  if (plan.moving) state.velocity = numbers(arrow(plan.speed()));
  state.velocity[statement_.axis] += statement_.more_speed;
  Place<D> place{stranger_, r, state.velocity, static_cast<int>(spare_.size()),
                 "p" + std::to_string(particles_.size())};
  attempt(place.text + " = add_particle({" + write(state.mass) + ", " + write<D>(state.position) + ", " +
              write<D>(state.velocity) + "})",
          [&] {
            const auto particle = scene.add_particle(state, name());
            drive(particle, state.mass);
            place.point = particle;
            particles_.push_back(place);
          });
  spare_.push_back(D);
  return place;
}

template <int D>
void Draft<D>::add_body() {
  BodyState<D> state;
  state.mass = size(plan.mass);
  state.centre = numbers(plan.length * random.vector<D>() + origin_);
  if (plan.moving) state.velocity = numbers(plan.speed() * random.vector<D>());
  state.velocity[statement_.axis] += statement_.more_speed;
  const double extent = plan.length * random.decades(-plan.spread, 0.0);
  Eigen::Matrix<double, D, D> axes;
  if constexpr (D == 2) {
    state.inertia = number(state.mass * extent * extent);
    state.angle = number(random.between(-3.0, 3.0));
    if (plan.moving) state.angular_velocity = number(plan.turns * random.between(-1.0, 1.0) / plan.time);
    state.angular_velocity += statement_.more_spin;
    axes = Eigen::Rotation2Dd(state.angle).toRotationMatrix();
  } else {
    Vec<3> square;
    for (int k = 0; k < 3; ++k) square[k] = state.mass * std::pow(extent * random.decades(-1.0, 0.0), 2);
    state.inertia = numbers(Vec<3>::Constant(square.sum()) - square);
    axes = Eigen::Quaterniond{random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0),
                              random.between(0.1, 1.0)}
               .normalized()
               .toRotationMatrix();
    state.axes = axes;
    if (plan.moving) state.angular_velocity = numbers(plan.turns * random.vector<3>() / plan.time);
    state.angular_velocity[statement_.axis] += statement_.more_spin;
  }
  const int owner = static_cast<int>(spare_.size());
  spare_.push_back(D == 2 ? 3 : 6);
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << 'b' << bodies_.size() << " = add_body(mass " << state.mass << ", inertia " << state.inertia
       << ", centre " << state.centre.transpose() << ", velocity " << state.velocity.transpose()
       << ", angular velocity " << state.angular_velocity << ", axes " << axes << ')';
  attempt(text.str(), [&] {
    const auto body = dalembert::add_body(scene, state, body_name());
    drive(body.point(Vec<D>::Zero()), state.mass);
    bodies_.push_back({body, state.centre, state.velocity, axes, owner});
  });
}

template <int D>
void Draft<D>::add_rotor() {
  RotorState state;
  state.inertia = size(plan.mass * plan.length * plan.length);
  state.angle = number(random.between(-3.0, 3.0));
  if (plan.moving) state.angular_velocity = number(random.between(-1.0, 1.0) / plan.time);
  state.angular_velocity += statement_.more_spin;
  const std::string text = "w" + std::to_string(wheels_.size());
  attempt(text + " = add_rotor({" + write(state.inertia) + ", " + write(state.angle) + ", " +
              write(state.angular_velocity) + "})",
          [&] {
            const Rotor rotor = scene.add_rotor(state, name());
            wheels_.push_back({rotor, state.angle, static_cast<int>(spare_.size()), text});
            spare_.push_back(1);
          });
}

template <int D>
Particle<D> Draft<D>::handle(Particle<D> meant) {
  if (!random.chance(0.3 * plan.wrong)) return meant;
  return random.chance(0.5) ? stranger_ : Particle<D>{};
}

template <int D>
Place<D> Draft<D>::particle() {
  if (particles_.empty()) add_particle();
  if (particles_.empty()) return {stranger_, Vec<D>::Zero(), Vec<D>::Zero(), -1, "stranger"};
  Place<D> place = particles_[static_cast<std::size_t>(random.below(static_cast<int>(particles_.size())))];
  place.point = handle(std::get<Particle<D>>(place.point));
  return place;
}

template <int D>
const typename Draft<D>::Body* Draft<D>::new_body() {
  const std::size_t before = bodies_.size();
  add_body();
  return bodies_.size() > before ? &bodies_.back() : nullptr;
}

template <int D>
Place<D> Draft<D>::point_at(const Body& body, const Vec<D>& local) const {
  return {body.body.point(local), body.centre + body.axes * local, body.velocity, body.owner,
          "body" + std::to_string(body.owner) + ".point(" + write<D>(local) + ")"};
}

template <int D>
Place<D> Draft<D>::mover() {
  if (bodies_.empty() || (!particles_.empty() && random.chance(0.6))) return particle();
  return point_of(bodies_[static_cast<std::size_t>(random.below(static_cast<int>(bodies_.size())))]);
}

template <int D>
Place<D> Draft<D>::ground() {
  const Vec<D> r = numbers(plan.length * random.vector<D>() + origin_);
  if (random.chance(plan.still)) return {Fixed<D>{r}, r, Vec<D>::Zero(), -1, "Fixed" + write<D>(r)};
  const SwingingPath<D> path{r, 0.2 * plan.length * random.vector<D>(), size(1.0 / plan.time),
                             plan.options.t_start};
  return {driven(path), r, path.amplitude * path.omega, -1,
          "driven(" + write<D>(r) + " + " + write<D>(path.amplitude) + " sin(" + write(path.omega) +
              " (t - " + write(path.start) + ")))"};
}

template <int D>
Place<D> Draft<D>::other_than(const Place<D>& a) {
  for (int i = 0; i < 10; ++i) {
    Place<D> b = any();
    if (b.owner != a.owner || b.owner < 0 || plan.kind == Plan::Kind::invalid) return b;
  }
  return ground();
}

template <int D>
Wheel Draft<D>::wheel() {
  if (wheels_.empty()) add_rotor();
  if (wheels_.empty()) return {Rotor{}, 0.0, -1, "no rotor"};
  Wheel w = wheels_[static_cast<std::size_t>(random.below(static_cast<int>(wheels_.size())))];
  if (random.chance(0.3 * plan.wrong)) w.rotor = Rotor{};
  return w;
}

template <int D>
bool Draft<D>::take(int rows, std::initializer_list<int> owners) {
  if (plan.kind != Plan::Kind::sensible) return true;
  for (const int owner : owners) {
    // One degree of freedom is kept: a scene that cannot move is a special case, left to the wild ones.
    if (owner < 0 || spare_[static_cast<std::size_t>(owner)] <= rows) continue;
    spare_[static_cast<std::size_t>(owner)] -= rows;
    return true;
  }
  return false;
}

template class Draft<2>;
template class Draft<3>;

}  // namespace dalembert::fuzz
