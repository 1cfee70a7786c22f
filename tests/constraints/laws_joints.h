#pragma once

#include "../equations.h"
#include "laws.h"
#include <dalembert/dalembert.h>

#include <array>
#include <functional>
#include <string>

/// The laws that every joint must satisfy: those of constraints at states near its manifold, and those of two
/// bodies that touch nothing else.
namespace dalembert::laws {

template <int D>
using Bodies = std::array<RigidBody<D>, 2>;

/// A joint between the two bodies of a scene or one of them and the ground, built through a placement.
template <int D>
struct Case {
  std::string name;
  int rows;
  std::function<void(Scene<D>&, const Placement<D>&, const Bodies<D>&)> add;
};

/// A scene of one case.
template <int D>
struct Built {
  Scene<D> scene;
  Bodies<D> bodies;
  System system;

  explicit Built(const Case<D>& c, const Placement<D>& at = {});
};

/// Time 0, where a drive of the cases agrees with the positions stated.
template <int D>
State stated(const Built<D>& built);

// The laws of one case that others add to those of all joints.
template <int D>
void expect_derivatives(const Case<D>& c);
/// What a joint of two bodies exerts on both has no resultant and no moment.
template <int D>
void expect_action_is_reaction(const Case<D>& c);

/// Registers one test; the suite is called after the law.
template <int D>
void register_case(const std::string& law, const Case<D>& c, void (*check)(const Case<D>&));

/// All laws but that of action and reaction.
template <int D>
void register_laws(const Case<D>& c);

/// All laws for one joint, of two bodies: `joint(at, a, b)`.
template <int D, class J>
void joint_of_bodies(const std::string& type, int rows, const J& joint) {
  const Case<D> c{type, rows, [joint](Scene<D>& scene, const Placement<D>& at, const Bodies<D>& b) {
                    scene.add(joint(at, b[0], b[1]));
                  }};
  register_case<D>("ActsOnBothBodiesAlike", c, expect_action_is_reaction<D>);
  register_laws(c);
}
/// And of the ground and a body, either first.
template <int D, class J>
void joint_of_ground(const std::string& type, int rows, const J& joint) {
  register_laws(Case<D>{type + "OfTheGround", rows,
                        [joint](Scene<D>& scene, const Placement<D>& at, const Bodies<D>& b) {
                          scene.add(joint(at, Ground<D>{}, b[1]));
                        }});
}
template <int D, class J>
void joint_to_ground(const std::string& type, int rows, const J& joint) {
  register_laws(Case<D>{type + "ToTheGround", rows,
                        [joint](Scene<D>& scene, const Placement<D>& at, const Bodies<D>& b) {
                          scene.add(joint(at, b[0], Ground<D>{}));
                        }});
}

}  // namespace dalembert::laws
