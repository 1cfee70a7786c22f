#include "../solvers/scenes.h"
#include <dalembert/core/analysis/virtual_work.h>

#include <gtest/gtest.h>

#include <barrier>
#include <thread>
#include <vector>

namespace dalembert {
namespace {

/// Every number of a run, so that two can be compared by their bits (none is a NaN).
template <int D>
std::vector<double> numbers(const Trajectory<D>& run) {
  std::vector<double> all;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const FlatSample s = run.sample(i).flat();
    for (const auto part : {s.q, s.v, s.a, s.lambda, s.forces})
      all.insert(all.end(), part.begin(), part.end());
    all.push_back(s.energy);
  }
  return all;
}

/// A scene made, described, run and analysed from the beginning: all that a thread may do at once.
std::vector<double> run_all_kinds(Stepper stepper) {
  const EachKind kinds;
  (void)kinds.scene.describe();
  const auto run = simulate(kinds.scene, {.t_end = 1.0, .samples = 11, .stepper = stepper});
  auto all = numbers(run);
  all.push_back(virtual_work(kinds.scene, run.sample(run.size() - 1)).largest);
  return all;
}

/// Two bodies in space hinged to each other, one of their rods stated twice: equations are left out.
std::vector<double> run_bodies(Stepper stepper) {
  Scene<3> scene("bodies");
  scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
  const auto body = [&scene](const char* name, double x) {
    return add_body(scene, BodyState<3>{.mass = 1.0, .inertia = {0.02, 0.03, 0.04}, .centre = {x, 0.0, 0.0}},
                    name);
  };
  const auto a = body("a", 0.5), b = body("b", 1.5);
  scene.add(Coincident{Fixed<3>{}, a.point({-0.5, 0.0, 0.0})});
  scene.add(Coincident{a.point({0.5, 0.0, 0.0}), b.point({-0.5, 0.0, 0.0})});
  scene.add(Distance{a.point({0.1, 0.0, 0.0}), a.point({-0.1, 0.0, 0.0}), 0.2});
  return numbers(simulate(scene, {.t_end = 1.0, .samples = 11, .stepper = stepper}));
}

/// Both started at the same moment, and again while the other is at something else.
template <class F, class G>
void expect_independent(const F& f, const G& g) {
  constexpr int repeats = 3;
  const std::vector<double> f_alone = f(), g_alone = g();
  std::vector<std::vector<double>> f_runs(repeats), g_runs(repeats);
  std::barrier ready(2);
  const auto repeat = [&ready](const auto& run, auto& results) {
    ready.arrive_and_wait();
    for (auto& result : results) result = run();
  };
  {
    const std::jthread one([&] { repeat(f, f_runs); });
    const std::jthread other([&] { repeat(g, g_runs); });
  }
  for (const auto& run : f_runs) EXPECT_EQ(run, f_alone);
  for (const auto& run : g_runs) EXPECT_EQ(run, g_alone);
}

TEST(Threads, TheSameSceneInTwoThreadsGivesTheBitsItGivesAlone) {
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    const auto run = [stepper] { return run_all_kinds(stepper); };
    expect_independent(run, run);
  }
}

TEST(Threads, DifferentScenesAndSteppersDoNotDisturbEachOther) {
  expect_independent([] { return run_all_kinds(Stepper::ida); }, [] { return run_bodies(Stepper::erk); });
  expect_independent([] { return run_all_kinds(Stepper::erk); }, [] { return run_bodies(Stepper::ida); });
}

/// Two simulations of one scene that neither changes, as its documentation of values allows.
TEST(Threads, TwoSimulationsMayReadOneScene) {
  const EachKind kinds;
  const auto run = [&kinds] { return numbers(simulate(kinds.scene, {.t_end = 1.0, .samples = 11})); };
  expect_independent(run, run);
}

/// One scene, a thousand copies with changed parameters over two threads: each gives the bits that it gives
/// alone, and in a scene built with those parameters from the beginning.
TEST(Threads, CopiesWithOtherParametersGiveTheBitsTheyGiveAlone) {
  struct Swing {
    Scene<2> scene{"swing"};
    Particle<2> bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "bob");
    Force gravity = scene.add(UniformGravity<2>{{0.0, -9.81}});
    Constraint<1> rod;
    Force spring;
    [[nodiscard]] static auto pivot(double amplitude) {
      return driven([amplitude](auto t) { return vec(amplitude * (1.0 - cos(5.0 * t)), 0.0); });
    }
    explicit Swing(double k, double amplitude) {
      rod = scene.add(Distance{pivot(amplitude), bob, 1.0}, "rod");
      spring = scene.add(Spring{Fixed<2>{{0.0, -2.0}}, bob, k}, "spring");
    }
  };
  constexpr std::size_t copies = 1000;
  const Swing original(1.0, 0.0);
  const auto stiffness = [](std::size_t i) { return 0.01 * static_cast<double>(i); };
  const auto amplitude = [](std::size_t i) { return 1e-4 * static_cast<double>(i % 7); };
  const auto run_copy = [&](std::size_t i) {
    Scene<2> copy = original.scene;
    copy.replace(original.rod, Distance{Swing::pivot(amplitude(i)), original.bob, 1.0});
    copy.replace(original.spring, Spring{Fixed<2>{{0.0, -2.0}}, original.bob, stiffness(i)});
    return numbers(
        simulate(copy, {.t_end = 0.2, .samples = 3, .stepper = i % 2 == 0 ? Stepper::erk : Stepper::ida}));
  };
  std::vector<std::vector<double>> together(copies);
  const auto every_other = [&](std::size_t first) {
    for (std::size_t i = first; i < copies; i += 2) together[i] = run_copy(i);
  };
  { const std::jthread even(every_other, 0U), odd(every_other, 1U); }
  for (std::size_t i = 0; i < copies; ++i) {
    EXPECT_EQ(together[i], run_copy(i)) << i;
    const Swing anew(stiffness(i), amplitude(i));
    EXPECT_EQ(
        together[i],
        numbers(simulate(anew.scene,
                         {.t_end = 0.2, .samples = 3, .stepper = i % 2 == 0 ? Stepper::erk : Stepper::ida})))
        << i;
  }
}

/// What lies between the samples is found where it is asked for; here of what slides, on lines and in planes.
TEST(Threads, TwoMayReadOneRunBetweenItsSamples) {
  const auto slide = []<int D>(Scene<D> scene, int pucks) {
    const Plane<D> plane;
    for (int i = 0; i < pucks; ++i) {
      const auto puck = scene.add_particle({.mass = 1.0, .velocity = (3.0 + i) * Vec<D>::UnitX()});
      if constexpr (D == 2) {
        scene.add(coulomb(scene.add(OnCurve{puck, plane}), Slip{puck, plane}, 0.1, 0.1));
      } else {
        scene.add(coulomb(scene.add(OnSurface{puck, plane}), Slip{puck, plane}, 0.1, 0.1));
      }
    }
    scene.add(UniformGravity<D>{-9.81 * plane.normal});
    return simulate(scene, {.t_end = 1.0, .samples = 2, .dense = true});
  };
  const auto lines = slide(Scene<2>("lines"), 2);
  const auto planes = slide(Scene<3>("planes"), 3);
  constexpr int count = 100;
  const auto time = [](int i) { return 1e-4 + 0.009 * i; };
  const auto read = [&](const auto& run) {
    std::vector<double> times;
    for (int i = 0; i < count; ++i) times.push_back(time(i));
    return numbers(run.at(times));
  };
  const auto in_turn = [&] {
    std::vector<double> of_lines, of_planes;
    for (int i = 0; i < count; ++i) {
      const auto line = numbers(lines.at({time(i)})), plane = numbers(planes.at({time(i)}));
      of_lines.insert(of_lines.end(), line.begin(), line.end());
      of_planes.insert(of_planes.end(), plane.begin(), plane.end());
    }
    EXPECT_EQ(of_lines, read(lines));
    EXPECT_EQ(of_planes, read(planes));
    return of_planes;
  };
  expect_independent(in_turn, in_turn);
}

/// The two runs of a certificate, on two threads each.
TEST(Threads, TwoMayCertifyAtOnce) {
  const auto certified = [] {
    Pendulum pendulum;
    const auto certificate =
        certify(pendulum.scene, {.t_end = 1.0, .samples = 11, .tolerance = 1e-6, .stepper = Stepper::erk});
    auto all = numbers(certificate.run());
    const auto better = numbers(certificate.reference());
    all.insert(all.end(), better.begin(), better.end());
    for (std::size_t i = 0; i < 11; ++i) all.push_back(certificate.position_error(pendulum.bob, i));
    return all;
  };
  expect_independent(certified, certified);
}

/// An error of one thread stays in it.
TEST(Threads, AFailureInOneThreadDoesNotReachTheOther) {
  const auto fails = [] {
    Pendulum pendulum;
    pendulum.scene.add(force_law(points(pendulum.bob), [](auto t, auto, auto v) {
      if (t > 0.5) throw std::runtime_error("a gale");
      return (-0.1 * v).eval();
    }));
    try {
      return numbers(simulate(pendulum.scene, {.t_end = 1.0, .samples = 11}));
    } catch (const IntegrationFailure& failure) {
      auto kept = numbers(failure.trajectory<2>());
      kept.push_back(failure.time());
      return kept;
    }
  };
  expect_independent(fails, [] { return run_bodies(Stepper::ida); });
}

}  // namespace
}  // namespace dalembert
