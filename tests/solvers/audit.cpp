#include <dalembert/dalembert.h>
#include <dalembert/solvers/audit/audited_dense.h>
#include <dalembert/solvers/audit/auditor.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

namespace dalembert::audit_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr double tolerance = 1e-8, g = 10.0;
constexpr Claim claim{.length = 1.0, .time = 1.0, .accuracy = tolerance};
/// A fault: far above the tolerance, far below what anyone would see.
constexpr double fault = 1e-5;

/// A sample whose numbers can be changed.
struct Numbers {
  double time, energy;
  std::vector<double> q, v, a, lambda, forces;

  explicit Numbers(const FlatSample& s)
      : time(s.time),
        energy(s.energy),
        q(s.q.begin(), s.q.end()),
        v(s.v.begin(), s.v.end()),
        a(s.a.begin(), s.a.end()),
        lambda(s.lambda.begin(), s.lambda.end()),
        forces(s.forces.begin(), s.forces.end()) {}
  [[nodiscard]] FlatSample flat() const { return {time, q, v, a, lambda, forces, energy}; }

  /// Another multiplier of a row, with all that follows from it: the forces, and the accelerations by Newton.
  void exert(const System& system, std::size_t row, double other) {
    auto e = system.evaluation();
    system.evaluate({time, q, v}, e);
    for (const std::size_t k : system.row(row)) {
      const std::size_t i = system.w_columns()[k];
      a[i] += e.w[k] * (other - lambda[row]) / system.masses()[i];
    }
    lambda[row] = other;
    system.constraint_forces(e.w, lambda, forces);
  }
};

std::vector<Law> broken(const Findings& findings, const System& system) {
  std::vector<Law> laws;
  for (const Finding& one : findings.read(system).worst)
    if (one.size > one.limit) laws.push_back(one.law);
  return laws;
}

std::vector<Law> broken(const std::shared_ptr<const System>& system, const FlatSample& sample) {
  SampleLaws laws(system, claim);
  Findings findings;
  laws.check(sample, claim, findings);
  return broken(findings, *system);
}

/// A run of a scene, one of whose samples is falsified.
template <int D>
struct Falsified {
  explicit Falsified(const Scene<D>& scene, std::size_t sample = 1)
      : run(simulate(scene, {.t_end = 0.5, .samples = 2, .tolerance = tolerance})),
        system(std::make_shared<const System>(scene.system())),
        now(run.sample(sample).flat()) {}

  [[nodiscard]] std::size_t row(int constraint) const {
    return system->layout()->constraints[static_cast<std::size_t>(constraint)].own_rows().front();
  }
  [[nodiscard]] std::vector<Law> laws() const { return broken(system, now.flat()); }

  Trajectory<D> run;
  std::shared_ptr<const System> system;
  Numbers now;
};

struct TwoRods {
  TwoRods() {
    scene.add(UniformGravity<2>{{0.0, -g}});
    upper = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "upper");
    lower = scene.add_particle({.mass = 2.0, .position = {2.0, 0.0}}, "lower");
    rod = scene.add(Distance{Fixed<2>{}, upper, 1.0}, "rod");
    other = scene.add(Distance{upper, lower, 1.0}, "other rod");
  }
  Scene<2> scene{"two rods"};
  Particle<2> upper, lower;
  Constraint<1> rod, other;
};

TEST(Audit, PassesARightSample) {
  Falsified<2> right(TwoRods{}.scene);
  EXPECT_THAT(right.laws(), IsEmpty());
}

TEST(Audit, FindsASampleThatWasNotPutOntoItsConstraints) {
  Falsified<2> off(TwoRods{}.scene);
  for (double& q : off.now.q) q *= 1.0 + fault;  // both rods are longer then
  EXPECT_THAT(off.laws(), testing::Contains(Law::position));
}

TEST(Audit, FindsAVelocityThatIsNoneOfTheConstraints) {
  Falsified<2> off(TwoRods{}.scene);
  off.now.v[0] += fault;
  EXPECT_THAT(off.laws(), testing::Contains(Law::velocity));
}

TEST(Audit, FindsALostRow) {
  const TwoRods scene;
  Falsified<2> lost(scene.scene);
  lost.now.exert(*lost.system, lost.row(scene.other.index), 0.0);
  EXPECT_THAT(lost.laws(), ElementsAre(Law::acceleration));
}

TEST(Audit, FindsADoubledForce) {
  Falsified<2> doubled(TwoRods{}.scene);
  doubled.now.a[1] -= g;
  EXPECT_THAT(doubled.laws(), testing::IsSupersetOf({Law::newton}));
}

TEST(Audit, FindsForcesAtPointsThatAreNotThoseOfTheMultipliers) {
  Falsified<2> off(TwoRods{}.scene);
  off.now.forces[0] += fault * g;
  EXPECT_THAT(off.laws(), ElementsAre(Law::point_forces));
}

TEST(Audit, FindsAnEnergyThatIsNotThatOfTheState) {
  Falsified<2> off(TwoRods{}.scene);
  off.now.energy += fault * g;
  EXPECT_THAT(off.laws(), ElementsAre(Law::energy));
}

TEST(Audit, PassesOverWhatIsNotDetermined) {
  const TwoRods scene;
  Falsified<2> unknown(scene.scene);
  for (auto* part : {&unknown.now.a, &unknown.now.lambda, &unknown.now.forces})
    std::ranges::fill(*part, std::numeric_limits<double>::quiet_NaN());
  EXPECT_THAT(unknown.laws(), IsEmpty());
}

TEST(Audit, FindsAForceOfACompliantConstraintThatIsNotThatOfItsDeflection) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  const auto rod = scene.add(compliant(Distance{Fixed<2>{}, bob, 1.1}, 1e-2));
  Falsified<2> off(scene);
  EXPECT_THAT(off.laws(), IsEmpty());
  const double lambda = off.now.lambda[off.row(rod.index)];
  off.now.exert(*off.system, off.row(rod.index), lambda + 0.01);
  off.now.energy += 0.5 * 1e-2 * ((lambda + 0.01) * (lambda + 0.01) - lambda * lambda);
  EXPECT_THAT(off.laws(), ElementsAre(Law::compliance));
}

TEST(Audit, FindsANonholonomicRowThatIsOff) {
  Scene<2> scene;
  const auto p = scene.add_particle({.mass = 1.0, .velocity = {1.0, 0.0}});
  scene.add(nonholonomic(points(p), [](auto, auto v) { return v.y(); }), "heading");
  Falsified<2> off(scene);
  EXPECT_THAT(off.laws(), IsEmpty());
  off.now.v[1] += fault;
  EXPECT_THAT(off.laws(), ElementsAre(Law::velocity));
}

/// A block of mass 1 on a floor.
struct Block {
  explicit Block(double speed = 0.0) {
    scene.add(UniformGravity<2>{{0.0, -g}});
    block = scene.add_particle({.mass = 1.0, .velocity = {speed, 0.0}}, "block");
    floor = scene.add(unilateral(OnCurve{block, Plane<2>{}}), "floor");
  }
  void make_rough(double mu, double mu_static) {
    rough = scene.add(coulomb(floor, Slip{block, Plane<2>{}}, mu, mu_static), "rough");
  }
  Scene<2> scene{"block"};
  Particle<2> block;
  Constraint<1> floor, rough;
};

TEST(Audit, FindsAContactThatPulls) {
  const Block scene;
  Falsified<2> pulls(scene.scene);
  EXPECT_THAT(pulls.laws(), IsEmpty());
  pulls.now.exert(*pulls.system, pulls.row(scene.floor.index), -1.0);
  EXPECT_THAT(pulls.laws(), UnorderedElementsAre(Law::acceleration, Law::no_pull));
}

TEST(Audit, FindsPenetration) {
  const Block scene;
  Falsified<2> deep(scene.scene);
  deep.now.exert(*deep.system, deep.row(scene.floor.index), 0.0);
  deep.now.q[1] = -fault;
  deep.now.energy -= g * fault;
  EXPECT_THAT(deep.laws(), ElementsAre(Law::no_penetration));
}

TEST(Audit, FindsAForceAcrossAGap) {
  const Block scene;
  Falsified<2> distant(scene.scene);
  distant.now.q[1] = fault;
  distant.now.energy += g * fault;
  EXPECT_THAT(distant.laws(), ElementsAre(Law::no_distant_force));
}

TEST(Audit, FindsFrictionThatPushes) {
  Block scene(5.0);
  scene.make_rough(0.3, 0.4);
  Falsified<2> pushes(scene.scene);
  EXPECT_THAT(pushes.laws(), IsEmpty());
  const std::size_t row = pushes.row(scene.rough.index);
  pushes.now.exert(*pushes.system, row, -pushes.now.lambda[row]);
  EXPECT_THAT(pushes.laws(), ElementsAre(Law::sliding));
}

TEST(Audit, FindsFrictionThatIsNotMuTimesTheNormalForce) {
  Block scene(5.0);
  scene.make_rough(0.3, 0.4);
  Falsified<2> weak(scene.scene);
  const std::size_t row = weak.row(scene.rough.index);
  weak.now.exert(*weak.system, row, (1.0 - fault) * weak.now.lambda[row]);
  EXPECT_THAT(weak.laws(), ElementsAre(Law::sliding));
}

TEST(Audit, FindsFrictionBeyondItsConeWhileItSticks) {
  Block scene;
  scene.make_rough(0.3, 0.4);
  Falsified<2> beyond(scene.scene);
  EXPECT_THAT(beyond.laws(), IsEmpty());
  beyond.now.exert(*beyond.system, beyond.row(scene.rough.index), 0.4 * g * (1.0 + fault));
  EXPECT_THAT(beyond.laws(), ElementsAre(Law::friction_cone));
}

TEST(Audit, FindsTheFrictionOfAnOpenContact) {
  Block scene(5.0);
  scene.make_rough(0.3, 0.4);
  Falsified<2> open(scene.scene);
  open.now.exert(*open.system, open.row(scene.floor.index), 0.0);
  open.now.q[1] = 1.0;
  open.now.energy += g;
  EXPECT_THAT(open.laws(), UnorderedElementsAre(Law::friction_cone, Law::sliding));
}

TEST(Audit, FindsForcesThatReadMultipliersInTheWrongDirection) {
  Block scene(5.0);
  scene.scene = Scene<2>("table");
  scene.scene.add(UniformGravity<2>{{0.0, -g}});
  const auto block = scene.scene.add_particle({.mass = 1.0, .velocity = {5.0, 0.0}});
  const auto table = scene.scene.add(OnCurve{block, Plane<2>{}});
  scene.scene.add(friction_law(table, points(block), [](auto lambda, auto, auto v) {
    return (-0.3 * lambda * v.normalized()).eval();
  }));
  Falsified<2> wrong(scene.scene);
  EXPECT_THAT(wrong.laws(), IsEmpty());
  wrong.now.a[0] = -wrong.now.a[0];
  EXPECT_THAT(wrong.laws(), ElementsAre(Law::newton));
}

/// Two masses above each other with something between them; the lower one strikes the floor at 3 m/s.
struct Struck {
  Struck() {
    low = scene.add_particle({.mass = 1.0}, "low");
    high = scene.add_particle({.mass = 2.0, .position = {0.0, 1.0}}, "high");
    floor = scene.add(unilateral(OnCurve{low, Plane<2>{}}, {.restitution = 0.5}), "floor");
    spring = scene.add(compliant(Distance{low, high, 1.0}, 1e-2), "spring");
    system = std::make_shared<const System>(scene.system());
    floor_row = system->layout()->constraints[static_cast<std::size_t>(floor.index)].own_rows().front();
    spring_row = system->layout()->constraints[static_cast<std::size_t>(spring.index)].own_rows().front();
    P.assign(system->rows(), 0.0);
    P[floor_row] = 1.0 * (1.5 + 3.0);
  }
  [[nodiscard]] std::vector<Law> laws() const {
    ImpactLaws impacts(system, claim);
    Findings findings;
    impacts.check({0.0, q, before, after, P, {}}, false, claim, findings);
    return broken(findings, *system);
  }
  Scene<2> scene{"struck"};
  Particle<2> low, high;
  Constraint<1> floor, spring;
  std::shared_ptr<const System> system;
  std::size_t floor_row = 0, spring_row = 0;
  std::vector<double> q{0.0, 0.0, 0.0, 1.0}, before{0.0, -3.0, 0.0, -3.0}, after{0.0, 1.5, 0.0, -3.0}, P;
};

TEST(AuditOfImpacts, PassesARightOne) { EXPECT_THAT(Struck{}.laws(), IsEmpty()); }

TEST(AuditOfImpacts, FindsAnImpulseThroughASpring) {
  // As if the spring were rigid: both masses rise at 1.5 m/s, P = 3 (1.5 + 3), of which the spring gives 9.
  Struck wrong;
  wrong.after[3] = 1.5;
  wrong.P[wrong.floor_row] = 13.5;
  wrong.P[wrong.spring_row] = 9.0;
  EXPECT_THAT(wrong.laws(), ElementsAre(Law::impulse_carrier));
}

TEST(AuditOfImpacts, FindsAnImpulseThatDoesNotBalance) {
  Struck wrong;
  wrong.P[wrong.floor_row] *= 1.0 + fault;
  EXPECT_THAT(wrong.laws(), ElementsAre(Law::impulse));
}

TEST(AuditOfImpacts, FindsAnotherRestitution) {
  Struck wrong;
  wrong.after[1] += fault;
  wrong.P[wrong.floor_row] += fault;
  EXPECT_THAT(wrong.laws(), ElementsAre(Law::restitution));
}

TEST(AuditOfImpacts, FindsEnergyThatNobodyPutIn) {
  Struck wrong;  // separates faster than it came
  wrong.after[1] = 3.0 + fault;
  wrong.P[wrong.floor_row] = 6.0 + fault;
  EXPECT_THAT(wrong.laws(), UnorderedElementsAre(Law::restitution, Law::impact_energy));
}

TEST(AuditOfImpacts, FindsAnImpulseThatPulls) {
  Struck wrong;
  wrong.after[1] = -4.0;
  wrong.P[wrong.floor_row] = -1.0;
  EXPECT_THAT(wrong.laws(), testing::Contains(Law::impulse_carrier));
}

TEST(AuditOfImpacts, FindsAnImpulseThroughAnOpenContact) {
  Struck wrong;
  wrong.q[1] = fault;
  EXPECT_THAT(wrong.laws(), ElementsAre(Law::impulse_carrier));
}

TEST(AuditOfWork, FindsEnergyThatChangesBetweenSamples) {
  const TwoRods scene;
  const auto system = std::make_shared<const System>(scene.scene.system());
  Falsified<2> later(scene.scene);
  const FlatSample start = later.run.sample(0).flat();
  for (const double gain : {0.0, 1e-2, -1e-2}) {  // of 20
    WorkBalance balance(system, claim);
    balance.start_interval(start.time, start.energy, start.v);
    for (int i = 1; i <= 100; ++i) {  // as many as an explicit run has
      std::vector<double> v = later.now.v;
      for (double& each : v) each *= 0.01 * i;
      balance.step(0.005 * i, v);
    }
    Numbers now = later.now;
    now.energy += gain;
    Findings findings;
    balance.check(now.flat(), claim, findings);
    EXPECT_THAT(broken(findings, *system), gain == 0.0 ? std::vector<Law>{} : std::vector<Law>{Law::work})
        << gain;
  }
}

TEST(AuditOfWork, LetsCoulombsFrictionTakeEnergyButNotGiveIt) {
  Block scene(5.0);
  scene.make_rough(0.3, 0.4);
  const auto system = std::make_shared<const System>(scene.scene.system());
  Falsified<2> later(scene.scene);
  for (const double energy : {2.0, 13.0}) {  // of 12.5
    WorkBalance balance(system, claim);
    balance.start_interval(0.0, 12.5, later.run.sample(0).flat().v);
    later.now.energy = energy;
    Findings findings;
    balance.check(later.now.flat(), claim, findings);
    EXPECT_EQ(broken(findings, *system).empty(), energy < 12.5);
  }
}

TEST(Audit, IsReadFromARunUnlessItIsOff) {
  const TwoRods right;
  const auto run = simulate(right.scene, {.t_end = 0.5, .samples = 6, .tolerance = tolerance});
  EXPECT_TRUE(run.audit().passed()) << run.audit().report();
  EXPECT_FALSE(run.audit().worst.empty());
  const auto unlooked = simulate(right.scene, {.t_end = 0.5, .samples = 6, .audit = Audited::off});
  EXPECT_TRUE(unlooked.audit().worst.empty());
}

/// Dense output whose rods are longer after 0.3.
class Stretched final : public DenseOutput {
 public:
  explicit Stretched(Trajectory<2> run) : run_(std::move(run)) {}
  void read(std::span<const double> times, Record& out) const override {
    const auto read = run_.at(times);
    for (std::size_t i = 0; i < read.size(); ++i) {
      Numbers now(read.sample(i).flat());
      if (now.time > 0.3)
        for (double& q : now.q) q *= 1.0 + fault;
      out.append(now.flat());
    }
  }

 private:
  Trajectory<2> run_;
};

TEST(Audit, FindsWhatDenseOutputGetsWrong) {
  const TwoRods rods;
  const auto run = simulate(rods.scene, {.t_end = 0.5, .samples = 2, .tolerance = tolerance, .dense = true});
  const auto system = std::make_shared<const System>(rods.scene.system());
  const AuditedDense audited(std::make_shared<Stretched>(run), {{0.0, system}}, claim);
  Record out;
  out.layout = system->layout();
  audited.read(std::vector{0.1, 0.2}, out);
  EXPECT_EQ(out.times.size(), 2U);
  try {
    audited.read(std::vector{0.25, 0.4}, out);
    FAIL() << "nobody noticed";
  } catch (const EquationFault& found) {
    EXPECT_THAT(found.what(), testing::HasSubstr("at(0.4)"));
    EXPECT_THAT(found.what(), testing::HasSubstr(name(Law::position)));
    EXPECT_THAT(found.what(), testing::HasSubstr("rod"));
  }
}

TEST(Audit, ReadsDenseOutputByWhatTheSceneStatedThen) {
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    Scene<2> scene("fall");
    const auto gravity = scene.add(UniformGravity<2>{{0.0, -g}});
    const auto ball = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "ball");
    const Event<2> weaker{"weaker", [](const auto& now) { return now.time() - 0.25; }, Crossing::rising,
                          false,
                          [=](Scene<2>& s) {
                            s.replace(gravity, UniformGravity<2>{{0.0, -0.1 * g}});
                          }};
    const Options options{
        .t_end = 0.5, .samples = 2, .tolerance = tolerance, .stepper = stepper, .dense = true, .length = 1.0};
    const auto read = simulate(scene, options, {weaker}).at({0.1, 0.25, 0.4});
    EXPECT_NEAR(read.acceleration(ball, 0).y(), -g, 1e-13 * g);
    EXPECT_NEAR(read.acceleration(ball, 1).y(), -g, 1e-13 * g);
    EXPECT_NEAR(read.acceleration(ball, 2).y(), -0.1 * g, 1e-13 * g);
  }
}

/// A potential of value 0 with the gradient of V = x.
TEST(Audit, StopsARunByNameAndKeepsTheSamplesBefore) {
  Scene<2> scene("liar");
  const auto p = scene.add_particle({.mass = 1.0});
  scene.add(potential(points(p), [](auto r) {
    using S = std::remove_cvref_t<decltype(r.x())>;
    return S::with_value(r.x(), 0.0);
  }));
  const Options options{.t_end = 1.0, .samples = 11, .tolerance = tolerance, .length = 1.0};
  try {
    (void)simulate(scene, options);
    FAIL() << "nobody noticed";
  } catch (const IntegrationFailure& failure) {
    EXPECT_THAT(failure.what(), testing::HasSubstr(name(Law::work)));
    EXPECT_THAT(failure.what(), testing::HasSubstr("liar"));
    EXPECT_EQ(failure.trajectory<2>().size(), 1U);
  }
  Options report = options;
  report.audit = Audited::report;
  const auto run = simulate(scene, report);
  EXPECT_EQ(run.size(), 11U);
  EXPECT_FALSE(run.audit().passed());
}

}  // namespace
}  // namespace dalembert::audit_test
