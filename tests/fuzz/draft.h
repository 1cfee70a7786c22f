#pragma once

#include "plan.h"
#include <dalembert/dalembert.h>

#include <Eigen/Core>

#include <functional>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

namespace dalembert::fuzz {

template <int D>
using AnyPoint = std::variant<Particle<D>, BodyPoint<D>, Fixed<D>, Driven<D, SwingingPath<D>>>;

/// A point, its position at the start, and what it belongs to.
template <int D>
struct Place {
  AnyPoint<D> point;
  Vec<D> r = Vec<D>::Zero();
  Vec<D> v = Vec<D>::Zero();
  int owner = -1;  ///< the particle or body it stands on; none for a fixed or driven one
  std::string text;
};

template <int D>
const Particle<D>& handle(const Place<D>& place) {
  return std::get<Particle<D>>(place.point);
}

/// One of the ways in which a scene is stated and started.
struct Statement {
  bool lean = false;         ///< without what is redundant
  bool springs = false;      ///< compliant rods as forces
  bool regularised = false;  ///< Coulomb's friction by a law that is smooth at rest
  double more_speed = 0.0;   ///< added to every initial velocity along `axis` [length / time]
  double more_spin = 0.0;    ///< to every angular velocity [1 / time]
  double drive = 0.0;        ///< times mass and velocity is a force on every particle and body [1 / time]
  int axis = 0;
};
/// Which statements an element belongs to.
enum class In { both, full, lean };

struct Wheel {
  Rotor rotor;
  double angle;
  int owner;
  std::string text;
};

/// A random scene in the making: what the elements are put on, and how their numbers are drawn. A log
/// of what was added lets a failing scene be written down again by hand.
template <int D>
class Draft {
 public:
  Draft(const Random& random, const Plan& plan, const Statement& statement = {});
  /// The same draws from the beginning.
  [[nodiscard]] Draft again(const Plan& p, const Statement& statement) const {
    return {start_, p, statement};
  }

  struct Body {
    RigidBody<D> body;
    Vec<D> centre, velocity;
    Eigen::Matrix<double, D, D> axes;
    int owner;
  };

  Random random;
  const Plan& plan;
  Scene<D> scene{"fuzz"};
  std::vector<Event<D>> events;

  /// A number as meant, or in an invalid scene now and then a wrong one.
  [[nodiscard]] double number(double meant) {
    return random.chance(plan.wrong) ? wrong_number(random, meant) : meant;
  }
  /// A positive number of the order of `unit`, as far as the plan's spread lets it stray.
  [[nodiscard]] double size(double unit) { return number(unit * random.decades(-plan.spread, plan.spread)); }
  /// The same with a direction.
  [[nodiscard]] Vec<D> arrow(double unit) {
    const double length = size(unit);
    return length * random.direction<D>();
  }
  [[nodiscard]] Vec<D> numbers(Vec<D> meant) {
    if (random.chance(plan.wrong)) meant[random.below(D)] = wrong_number(random, meant[0]);
    return meant;
  }
  /// Empty, or in an invalid scene now and then one that may be taken.
  [[nodiscard]] std::string name() { return random.chance(plan.wrong) ? "taken" : ""; }
  [[nodiscard]] std::string body_name() {
    return random.chance(plan.wrong) ? "taken" : "body" + std::to_string(next_body_++);
  }
  [[nodiscard]] Fuse fuse();

  [[nodiscard]] Place<D> particle();  ///< adds one if there is none
  [[nodiscard]] Place<D> mover();     ///< a particle or a point of a body
  [[nodiscard]] Place<D> ground();    ///< a fixed or driven point
  [[nodiscard]] Place<D> any() { return random.chance(0.6) ? mover() : ground(); }
  /// Another than `a`, on another owner unless nothing else is to be had.
  [[nodiscard]] Place<D> other_than(const Place<D>& a);
  [[nodiscard]] Wheel wheel();  ///< adds one if there is none
  [[nodiscard]] Place<D> new_particle(const Vec<D>& r);
  /// A new one; none if it is refused.
  [[nodiscard]] const Body* new_body();
  [[nodiscard]] Place<D> point_at(const Body& body, const Vec<D>& local) const;
  void add_particle() { (void)new_particle(plan.length * random.vector<D>() + origin_); }
  void add_body();
  void add_rotor();
  [[nodiscard]] const Vec<D>& origin() const { return origin_; }
  [[nodiscard]] const std::vector<Place<D>>& particles() const { return particles_; }
  [[nodiscard]] const Statement& statement() const { return statement_; }
  [[nodiscard]] const Body* last_body() const { return bodies_.empty() ? nullptr : &bodies_.back(); }

  /// Whether a sensible scene has room for a constraint of this many rows on these owners; takes it.
  [[nodiscard]] bool take(int rows, std::initializer_list<int> owners);

  /// Adds to the scene what `make` returns and writes it down; what the library refuses is left out.
  template <class Element>
  void add(const std::string& text, const Element& element, In statement = In::both) {
    const std::string its_name = name();
    if (statement == In::both || (statement == In::lean) == statement_.lean)
      attempt(text, [&] { scene.add(element, its_name); });
    if constexpr (!std::is_same_v<decltype(scene.add(element)), Force>) {  // a force twice is twice the force
      if (statement == In::both && plan.repeat > 0.0 && random.chance(plan.repeat))
        add("  again " + text, element, In::full);
    }
  }
  void attempt(const std::string& text, const std::function<void()>& f);

  [[nodiscard]] const std::string& log() const { return log_; }
  /// What the library refused in a scene that is sensible: a defect, here or there.
  [[nodiscard]] const std::string& refused() const { return refused_; }

 private:
  [[nodiscard]] Place<D> point_of(const Body& body) {
    return point_at(body, plan.length * random.vector<D>());
  }
  [[nodiscard]] Particle<D> handle(Particle<D> meant);
  /// With the statement's force.
  void drive(const auto& point, double mass) {
    if (statement_.drive == 0.0) return;
    scene.add(force_law(dalembert::points(point),
                        [k = statement_.drive * mass](const auto&, const auto& v) { return k * v; }));
  }

  Random start_;
  Statement statement_;
  Vec<D> origin_ = Vec<D>::Zero();
  Scene<D> foreign_{"foreign"};
  Particle<D> stranger_;
  std::vector<Place<D>> particles_;
  std::vector<Body> bodies_;
  std::vector<Wheel> wheels_;
  std::vector<int> spare_;  // degrees of freedom left, per owner
  int next_body_ = 0;
  std::string log_, refused_;
};

extern template class Draft<2>;
extern template class Draft<3>;

/// A vector or a number with all its digits, as one writes it in a scene.
std::string write(double value);
template <int D>
std::string write(const Vec<D>& r) {
  std::string text = "{";
  for (int k = 0; k < D; ++k) text += (k > 0 ? ", " : "") + write(r[k]);
  return text + "}";
}
inline std::string write(const Fuse& fuse) {
  if (fuse.kind == Fuse::Kind::none) return "";
  return " fuse " + std::to_string(static_cast<int>(fuse.kind)) + " at " + write(fuse.time);
}
/// `kind{a, b, ...}`
template <class... Part>
std::string call_text(const std::string& kind, const Part&... part) {
  const auto as_text = [](const auto& p) {
    if constexpr (std::is_convertible_v<decltype(p), std::string>) {
      return std::string(p);
    } else {
      return write(p);
    }
  };
  std::string all;
  ((all += (all.empty() ? "" : ", ") + as_text(part)), ...);
  return kind + "{" + all + "}";
}

/// One random element each, of the kinds in the source file of that name.
template <int D>
void add_rod(Draft<D>& draft);
/// Between two points of which the second moves, of the length given.
template <int D>
void add_distance(Draft<D>& draft, const Place<D>& a, const Place<D>& b, double length, In statement);
template <int D>
void add_pin(Draft<D>& draft);
/// Holds two points together of which the second moves.
template <int D>
void add_ball(Draft<D>& draft, const Place<D>& a, const Place<D>& b, In statement);
/// A part of the scene with redundant constraints: a hinge, a frame, a rod.
template <int D>
void add_redundant(Draft<D>& draft);
template <int D>
void add_own_holonomic(Draft<D>& draft);
template <int D>
void add_own_nonholonomic(Draft<D>& draft);
template <int D>
void add_prescribed(Draft<D>& draft);
void add_on_curve(Draft<2>& draft);
void add_rolling(Draft<2>& draft);
void add_on_surface(Draft<3>& draft);
void add_disk(Draft<3>& draft);
void add_thin_rod(Draft<3>& draft);
template <int D>
void add_force(Draft<D>& draft);
template <int D>
void add_field(Draft<D>& draft);
template <int D>
void add_own_force(Draft<D>& draft);
/// A force, or a constraint, with a kink or a jump.
template <int D>
void add_kinked(Draft<D>& draft);
/// A force that has an energy or dissipates some.
template <int D>
void add_passive_force(Draft<D>& draft);
/// A floor or a wall, a string, a sphere, two particles that may meet: one-sided constraints.
template <int D>
void add_one_sided(Draft<D>& draft);
/// Coulomb's friction of a particle on a plane or sphere.
template <int D>
void add_rough(Draft<D>& draft);

/// Speed below which regularised friction is weaker than Coulomb's, as a part of the plan's; and how far that
/// may take a motion over the two times that a product runs, as a part of its length: it creeps where the
/// other sticks, at up to a few times this speed.
inline constexpr double regularised_below = 3e-3, regularised_within = 0.1;

/// A scene of the features of its plan.
template <int D>
void fill_product(Draft<D>& draft);
/// A whole scene.
template <int D>
void fill(Draft<D>& draft);

}  // namespace dalembert::fuzz
