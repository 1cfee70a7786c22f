#include <dalembert/dalembert.h>
#include <dalembert/tests/both_steppers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

/// Scenes in which compliant constraints meet every other feature, each beside its twin with `Spring` in
/// their place: a spring of moderate stiffness is right either way.
namespace dalembert::compliance_beside_others_test {
namespace {

constexpr double g = 9.81;

/// Springs as constraints or as forces.
struct CompliantMultipliers {
  bool compliant;

  template <int D, class A, class B>
  void add(Scene<D>& scene, const A& a, const B& b, double stiffness, double length) const {
    if (compliant) {
      scene.add(dalembert::compliant(Distance{a, b, length}, 1.0 / stiffness));
    } else {
      scene.add(Spring{a, b, stiffness, length});
    }
  }
};

/// What is added to it before its springs has the same numbers in both twins.
template <int D>
struct Built {
  Scene<D> scene;
  std::vector<Particle<D>> watched{};
  double t_end = 1.0;
  std::vector<Event<D>> events{};
  std::size_t constraints = 0;  // that both twins have
  bool accumulates = false;     // impacts, until they end in rest: of the same number to the tolerance only

  explicit Built(const std::string& name) : scene(name) {
    scene.add(UniformGravity<D>{-g * Vec<D>::Unit(D - 1)});
  }
  Particle<D> particle(double mass, const Vec<D>& r, const Vec<D>& v = Vec<D>::Zero()) {
    watched.push_back(scene.add_particle({.mass = mass, .position = r, .velocity = v}));
    return watched.back();
  }
  template <class C>
  auto constrain(const C& constraint, const std::string& name) {
    return scene.add(constraint, name + ' ' + std::to_string(++constraints));
  }
};

/// Errors of a run of a second, and what impacts and stick-slip make of them, in units of the tolerance.
constexpr double tolerance = 1e-9, bound = 2e4 * tolerance;

class CompliantTwin : public testing::TestWithParam<Stepper> {
 protected:
  template <int D>
  void compare(const std::function<Built<D>(CompliantMultipliers)>& build) {
    const Built<D> own = build({true}), twin = build({false});
    const Options options{.t_end = own.t_end, .samples = 41, .tolerance = tolerance, .stepper = GetParam()};
    Options exact = options;
    exact.tolerance = 1e-11;
    exact.stepper = Stepper::erk;
    Options dense = options;
    dense.dense = true;
    const auto run = simulate(own.scene, dense, own.events), right = simulate(twin.scene, exact, twin.events);
    expect_same(own, twin, run, right);
    expect_same_events(run, right, own.accumulates);
    const auto again = run.at(run.times());
    Simulation<D> steps(own.scene, options, own.events);
    for (std::size_t i = 0; i < run.size(); ++i) {
      steps.advance_to(run.times()[i]);
      for (const auto p : own.watched) {
        EXPECT_LE((steps.position(p) - run.position(p, i)).norm(), 1e-12);
        EXPECT_LE((again.position(p, i) - run.position(p, i)).norm(), bound) << run.times()[i];
        EXPECT_LE((again.acceleration(p, i) - run.acceleration(p, i)).norm(), 1e3 * bound) << run.times()[i];
      }
    }
  }

  template <int D>
  void expect_same(const Built<D>& own, const Built<D>& twin, const Trajectory<D>& run,
                   const Trajectory<D>& right) {
    ASSERT_EQ(run.size(), right.size());
    for (std::size_t i = 0; i < run.size(); ++i) {
      double most = 1.0;
      for (const auto p : twin.watched) most = std::max(most, right.acceleration(p, i).norm());
      for (std::size_t k = 0; k < own.watched.size(); ++k) {
        const auto p = own.watched[k], other = twin.watched[k];
        EXPECT_LE((run.position(p, i) - right.position(other, i)).norm(), bound) << run.times()[i];
        EXPECT_LE((run.velocity(p, i) - right.velocity(other, i)).norm(), 10.0 * bound) << run.times()[i];
        EXPECT_LE((run.acceleration(p, i) - right.acceleration(other, i)).norm(), 10.0 * bound * most)
            << run.times()[i];
      }
      EXPECT_NEAR(run.energy(i), right.energy(i), 100.0 * bound * std::max(1.0, std::abs(right.energy(i))));
      const auto a = run.sample(i), b = right.sample(i);
      for (std::size_t c = 0; c < own.constraints; ++c) {
        for (int k = 0; k < a.layout().constraints[c].rows; ++k) {
          const auto row_a = static_cast<std::size_t>(a.layout().constraints[c].first_row + k);
          const auto row_b = static_cast<std::size_t>(b.layout().constraints[c].first_row + k);
          if (!b.flat().unique.empty() && !b.flat().unique[row_b]) continue;
          EXPECT_NEAR(a.flat().lambda[row_a], b.flat().lambda[row_b], 10.0 * bound * most)
              << c << ' ' << run.times()[i];
        }
      }
    }
  }

  template <int D>
  void expect_same_events(const Trajectory<D>& run, const Trajectory<D>& right, bool accumulate) {
    const auto own = run.events(), twin = right.events();
    if (!accumulate) {
      ASSERT_EQ(own.size(), twin.size());
    } else {
      ASSERT_GT(std::min(own.size(), twin.size()), 3U);
    }
    for (std::size_t i = 0; i < (accumulate ? 3 : own.size()); ++i) {
      EXPECT_EQ(own[i].kind, twin[i].kind) << i;
      EXPECT_EQ(own[i].source, twin[i].source) << i;
      EXPECT_NEAR(own[i].time, twin[i].time, bound) << i;
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Steppers, CompliantTwin, both_steppers, stepper_name);

TEST_P(CompliantTwin, MovesAlikeBesideRedundantRods) {
  compare<2>([](CompliantMultipliers springs) {
    Built<2> b("redundant");
    const auto bob = b.particle(1.0, {1.0, 0.0}), low = b.particle(0.5, {1.0, -1.0});
    b.constrain(Distance{Fixed<2>{}, bob, 1.0}, "rod");
    b.constrain(holonomic(points(bob), [](auto r) { return r.squaredNorm() - 1.0; }), "the same");
    springs.add(b.scene, bob, low, 200.0, 1.0);
    return b;
  });
}

TEST_P(CompliantTwin, MovesAlikeBetweenThePointsOfARod) {
  compare<2>([](CompliantMultipliers springs) {
    Built<2> b("parallel");
    const auto bob = b.particle(1.0, {1.0, 0.0}), low = b.particle(0.5, {2.0, 0.0});
    b.constrain(Distance{Fixed<2>{}, bob, 1.0}, "rod");
    b.constrain(Distance{bob, low, 1.0}, "second");
    springs.add(b.scene, Fixed<2>{}, bob, 1e4, 0.999);
    springs.add(b.scene, Fixed<2>{}, low, 100.0, 1.9);
    return b;
  });
}

TEST_P(CompliantTwin, MovesAlikeOnADrivenPin) {
  compare<2>([](CompliantMultipliers springs) {
    Built<2> b("driven");
    const auto bob = b.particle(1.0, {0.3, -1.0}), end = b.particle(0.2, {0.3, -1.5});
    b.constrain(Distance{bob, end, 0.5}, "rod");
    springs.add(b.scene, driven([](auto t) { return vec(0.3 * cos(3.0 * t), 0.1 * sin(5.0 * t)); }), bob,
                500.0, 1.0);
    b.t_end = 3.0;
    return b;
  });
}

TEST_P(CompliantTwin, DumbbellBouncesAlike) {
  compare<2>([](CompliantMultipliers springs) {
    Built<2> b("bounces");
    const auto low = b.particle(1.0, {0.0, 0.45}), high = b.particle(2.0, {0.2, 1.4});
    b.constrain(unilateral(OnCurve{low, Plane<2>{}}, {.restitution = 0.8}), "floor");
    b.constrain(unilateral(OnCurve{high, Plane<2>{}}, {.restitution = 0.8}), "floor of the other");
    springs.add(b.scene, low, high, 300.0, std::hypot(0.2, 0.95));
    b.t_end = 0.9;
    return b;
  });
}

TEST_P(CompliantTwin, StackLandsAndLiftsAlike) {
  compare<2>([](CompliantMultipliers springs) {
    Built<2> b("stack");
    const auto a = b.particle(1.0, {0.0, 0.2}), c = b.particle(2.0, {0.0, 1.2}),
               d = b.particle(1.0, {0.0, 2.2});
    b.constrain(unilateral(OnCurve{a, Plane<2>{}}), "floor");
    for (const auto p : {a, c, d}) b.constrain(OnCurve{p, Plane<2>{{0.0, 0.0}, {1.0, 0.0}}}, "guide");
    springs.add(b.scene, a, c, 400.0, 1.0);
    springs.add(b.scene, c, d, 300.0, 1.0);
    return b;
  });
}

TEST_P(CompliantTwin, BallComesToRestAlike) {
  compare<2>([](CompliantMultipliers springs) {
    Built<2> b("rests");
    const auto ball = b.particle(1.0, {0.0, 0.1});
    b.constrain(unilateral(OnCurve{ball, Plane<2>{}}, {.restitution = 0.4}), "floor");
    b.accumulates = true;
    springs.add(b.scene, ball, Fixed<2>{{0.0, 2.0}}, 30.0, 2.1);
    return b;
  });
}

TEST_P(CompliantTwin, BlockSticksAndSlipsAlike) {
  compare<2>([](CompliantMultipliers springs) {
    Built<2> b("stick-slip");
    const auto block = b.particle(1.0, {1.0, 0.0});
    const auto floor = b.constrain(OnCurve{block, Plane<2>{}}, "floor");
    b.constrain(coulomb(floor, Slip{block, Plane<2>{}}, 0.3, 0.4), "rough");
    springs.add(b.scene, driven([](auto t) { return vec(0.5 * t, 0.0); }), block, 100.0, 1.0);
    b.t_end = 1.5;
    return b;
  });
}

TEST_P(CompliantTwin, PressesARoughContactAlike) {
  compare<2>([](CompliantMultipliers springs) {
    Built<2> b("pressed");
    const auto block = b.particle(1.0, {0.0, 0.0}, {1.0, 0.0});
    const auto floor = b.constrain(unilateral(OnCurve{block, Plane<2>{}}), "floor");
    b.constrain(coulomb(floor, Slip{block, Plane<2>{}}, 0.3), "rough");
    springs.add(b.scene, Fixed<2>{{0.0, 1.0}}, block, 100.0, 1.05);
    return b;
  });
}

TEST_P(CompliantTwin, WheelRollsAlike) {
  compare<2>([](CompliantMultipliers springs) {
    Built<2> b("wheel");
    const auto centre = b.particle(1.0, {0.0, 0.5}), trailer = b.particle(1.0, {-1.0, 0.4});
    const auto wheel = b.scene.add_rotor({.inertia = 0.1});
    b.constrain(OnCurve{centre, Plane<2>{{0.0, 0.5}, {0.0, 1.0}}}, "track");
    b.constrain(Rolling{centre, wheel, Fixed<2>{}, Fixed<2>{{1.0, 0.0}}, 0.5}, "rolls");
    springs.add(b.scene, centre, trailer, 150.0, 1.0);
    return b;
  });
}

TEST_P(CompliantTwin, SkateMovesAlikeWithATrailer) {
  compare<2>([](CompliantMultipliers springs) {
    Built<2> b("skate");
    const auto front = b.particle(1.0, {1.0, 0.0}, {1.0, 0.0}),
               rear = b.particle(1.0, {0.0, 0.0}, {1.0, 0.3});
    b.constrain(nonholonomic(points(front, rear),
                             [](auto a, auto c, auto v, auto) {
                               const auto d = (a - c).eval();
                               return (d.x() * v.y() - d.y() * v.x()) / d.norm();
                             }),
                "blade");
    springs.add(b.scene, front, rear, 250.0, 1.0);
    return b;
  });
}

TEST_P(CompliantTwin, HingedBodiesMoveAlike) {
  compare<2>([](CompliantMultipliers springs) {
    Built<2> b("hinged");
    const auto arm = add_body<2>(b.scene, {.mass = 1.0, .inertia = 0.1, .centre = {0.5, 0.0}}, "arm");
    const auto hand = add_body<2>(b.scene, {.mass = 0.5, .inertia = 0.05, .centre = {1.5, 0.0}}, "hand");
    b.constraints = arm.rods.size() + hand.rods.size();
    b.constrain(Coincident{Fixed<2>{}, arm.point({-0.5, 0.0})}, "shoulder");
    b.constrain(Coincident{arm.point({0.5, 0.0}), hand.point({-0.5, 0.0})}, "wrist");
    b.watched = {arm.particles[0], arm.particles[1], hand.particles[0], hand.particles[1]};
    springs.add(b.scene, arm.point({0.0, 0.3}), hand.point({0.0, 0.3}), 80.0, 0.9);
    return b;
  });
}

TEST_P(CompliantTwin, BodyInSpaceMovesAlike) {
  compare<3>([](CompliantMultipliers springs) {
    Built<3> b("hung");
    const auto body = add_body<3>(
        b.scene, {.mass = 2.0, .inertia = {0.2, 0.3, 0.4}, .angular_velocity = {0.5, 1.0, -0.5}}, "body");
    b.constraints = body.rods.size();
    b.watched = {body.particles.begin(), body.particles.end()};
    b.constrain(OnSurface{body.centre(), Plane<3>{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}}, "wall");
    for (const Vec<3>& at : {Vec<3>{0.5, 0.0, 0.2}, Vec<3>{-0.4, 0.3, 0.2}, Vec<3>{-0.4, -0.3, 0.2}})
      springs.add(b.scene, Fixed<3>{at + Vec<3>{0.0, 0.0, 1.0}}, body.point(at), 200.0, 0.95);
    return b;
  });
}

TEST_P(CompliantTwin, StringGoesTautAlike) {
  compare<2>([](CompliantMultipliers springs) {
    Built<2> b("string");
    const auto bob = b.particle(1.0, {0.5, -0.2}), low = b.particle(0.3, {0.5, -0.7});
    b.constrain(
        unilateral(Distance{Fixed<2>{}, bob, 1.0}, {.allowed = Allowed::negative, .restitution = 0.5}),
        "string");
    b.accumulates = true;
    springs.add(b.scene, bob, low, 120.0, 0.5);
    springs.add(b.scene, bob, Fixed<2>{{0.0, -2.0}}, 20.0, 1.0);
    return b;
  });
}

TEST_P(CompliantTwin, BallsInARowBounceAlikeBetweenWalls) {
  compare<2>([](CompliantMultipliers springs) {
    Built<2> b("row");
    const auto a = b.particle(1.0, {0.0, 0.0}, {2.1, 0.0}), c = b.particle(1.0, {1.0, 0.0}),
               d = b.particle(1.0, {1.2, 0.0});
    for (const auto p : {a, c, d}) b.constrain(OnCurve{p, Plane<2>{}}, "line");
    const auto apart = [](auto p, auto q) { return q.x() - p.x() - 0.2; };
    b.constrain(unilateral(holonomic(points(a, c), apart), {.restitution = 1.0}), "first");
    b.constrain(unilateral(holonomic(points(c, d), apart), {.restitution = 1.0}), "second");
    springs.add(b.scene, c, Fixed<2>{{-3.0, 0.0}}, 50.0, 4.0);
    springs.add(b.scene, d, Fixed<2>{{4.0, 0.0}}, 80.0, 2.8);
    return b;
  });
}

TEST_P(CompliantTwin, ImposedConstraintActsAlike) {
  compare<2>([](CompliantMultipliers springs) {
    Built<2> b("imposed");
    const auto ball = b.particle(2.0, {0.6, 0.0}), other = b.particle(1.0, {0.9, 0.3});
    const auto rod = b.constrain(Distance{Fixed<2>{}, ball, 1.0}, "rod");
    b.scene.release(rod);
    springs.add(b.scene, ball, other, 300.0, 0.4);
    b.events = {{"taut", [ball](const auto& now) { return now.position(ball).norm() - 1.0; },
                 Crossing::rising, false, [rod](Scene<2>& scene) { scene.impose(rod); }}};
    return b;
  });
}

TEST_P(CompliantTwin, ChangeThrowsABallUpAlike) {
  // Off the floor, pulled by its spring, and the other onto the ceiling.
  compare<2>([](CompliantMultipliers springs) {
    Built<2> b("thrown");
    const auto low = b.particle(1.0, {0.0, 0.0}), high = b.particle(1.0, {0.0, 1.0});
    for (const auto p : {low, high}) {
      b.constrain(unilateral(OnCurve{p, Plane<2>{}}), "floor");
      b.constrain(unilateral(OnCurve{p, Plane<2>{{0.0, 1.5}, {0.0, -1.0}}}, {.restitution = 0.5}), "ceiling");
    }
    springs.add(b.scene, low, high, 150.0, 1.05);
    b.events = {
        {"thrown", [](const auto& now) { return now.time() - 0.3; }, Crossing::rising, false,
         [low](Scene<2>& scene) {
           scene.replace(low, ParticleState<2>{.mass = 1.0, .position = {0.0, 0.0}, .velocity = {0.0, 4.0}});
         }}};
    return b;
  });
}

TEST_P(CompliantTwin, MovesAlikeReleasedAndImposedAgain) {
  // The twin's spring loses its stiffness and gets it back.
  for (const bool again : {false, true}) {
    Scene<2> scene("cut"), twin("cut");
    std::vector<Particle<2>> bobs;
    for (auto* s : {&scene, &twin}) {
      s->add(UniformGravity<2>{{0.0, -g}});
      bobs.push_back(s->add_particle({.mass = 1.0, .position = {1.0, 0.0}}));
    }
    const auto rod = scene.add(compliant(Distance{Fixed<2>{}, bobs[0], 1.0}, 1e-2));
    const auto spring = [&](double k) { return Spring{Fixed<2>{}, bobs[1], k, 1.0}; };
    const auto force = twin.add(spring(100.0));
    const auto at = [](double time, std::function<void(Scene<2>&)> change) {
      return Event<2>{"t", [time](const auto& now) { return now.time() - time; }, Crossing::rising, false,
                      std::move(change)};
    };
    std::vector<Event<2>> own{at(0.5, [=](Scene<2>& s) { s.release(rod); })};
    std::vector<Event<2>> others{at(0.5, [=](Scene<2>& s) { s.replace(force, spring(0.0)); })};
    if (again) {
      own.push_back(at(0.6, [=](Scene<2>& s) { s.impose(rod); }));
      others.push_back(at(0.6, [=](Scene<2>& s) { s.replace(force, spring(100.0)); }));
    }
    const Options o{.t_end = 1.0, .samples = 21, .tolerance = tolerance, .stepper = GetParam()};
    const auto run = simulate(scene, o, own), right = simulate(twin, o, others);
    ASSERT_EQ(run.events().size(), own.size());
    for (std::size_t i = 0; i < run.size(); ++i) {
      EXPECT_LE((run.position(bobs[0], i) - right.position(bobs[1], i)).norm(), bound);
      if (std::abs(run.times()[i] - 0.5) < 0.01 || std::abs(run.times()[i] - 0.6) < 0.01) continue;
      const bool cut = run.times()[i] > 0.51 && (!again || run.times()[i] < 0.59);
      EXPECT_NEAR(run.multiplier(rod, i), cut ? 0.0 : -100.0 * (right.position(bobs[1], i).norm() - 1.0),
                  100.0 * bound);
    }
    for (std::size_t e = 0; e < own.size(); ++e) EXPECT_EQ(run.impulse(rod, e), 0.0);
  }
}

}  // namespace
}  // namespace dalembert::compliance_beside_others_test
