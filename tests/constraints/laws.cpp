#include "laws.h"

#include "../equations.h"
#include <dalembert/eigen.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <limits>
#include <utility>

namespace dalembert::laws {

template <>
Placement<2> elsewhere() {
  return {Eigen::Rotation2Dd(0.7).toRotationMatrix(), {3.0, -2.0}};
}
template <>
Placement<3> elsewhere() {
  return {Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix(),
          {3.0, -2.0, 1.0}};
}

void register_test(const char* suite, const std::string& name, const std::function<void()>& body) {
  class Test : public testing::Test {
   public:
    explicit Test(std::function<void()> its) : body_(std::move(its)) {}
    void TestBody() override { body_(); }

   private:
    std::function<void()> body_;
  };
  testing::RegisterTest(suite, name.c_str(), nullptr, nullptr, __FILE__, __LINE__,
                        [body]() -> testing::Test* { return new Test(body); });
}

namespace {

/// A system of that one constraint.
template <int D>
System system_of(const Add<D>& add, const Placement<D>& at = {}) {
  Scene<D> scene;
  const auto a = scene.add_particle({.mass = 1.0});
  const auto b = scene.add_particle({.mass = 2.0});
  add(scene, at, a, b);
  return scene.system();
}

/// A state in general position: nothing vanishes, nothing is a unit vector, no constraint holds. Two
/// particles, and rotors if the system has more coordinates.
template <int D>
State general_state(Eigen::Index n = 2 * D) {
  return {0.6, (Eigen::VectorXd(8) << 0.8, -0.5, 1.3, 0.4, 0.9, -0.7, 0.3, -1.6).finished().head(n),
          (Eigen::VectorXd(8) << -0.3, 1.2, 0.7, 0.9, -1.1, 0.5, 1.4, 0.2).finished().head(n)};
}

Eigen::VectorXd general_multipliers(Eigen::Index rows) {
  return Eigen::Vector4d(1.7, -0.9, 0.6, 2.1).head(rows);
}

/// Every derivative belongs to its equation.
template <int D>
void differentiates_its_equation(const Add<D>& add) {
  const System system = system_of<D>(add);
  expect_consistent(system, general_state<D>(index(system.coordinates())),
                    general_multipliers(index(system.rows())));
}

/// A second evaluation, and a second system, give the same bits.
template <int D>
void gives_the_same_bits_twice(const Add<D>& add) {
  const System one = system_of<D>(add);
  const System two = system_of<D>(add);
  const State s = general_state<D>(index(one.coordinates()));
  const Values first = values(one, s);
  const Eigen::VectorXd lambda = general_multipliers(index(one.rows()));
  const Derivatives d = derivatives(one, s, lambda);
  for (const System* system : {&one, &two}) {
    const Values again = values(*system, s);
    const Derivatives d_again = derivatives(*system, s, lambda);
    EXPECT_EQ(first.g, again.g);
    EXPECT_EQ(first.psi, again.psi);
    EXPECT_EQ(first.gamma, again.gamma);
    EXPECT_EQ(first.W, again.W);
    EXPECT_EQ(d.psi_q, d_again.psi_q);
    EXPECT_EQ(d.stiffness, d_again.stiffness);
  }
}

/// A multiplier is the force on a particle: its part of each row is a unit vector, or zero where
/// the row does not act on it. For signed distances this holds on the manifold and off it.
template <int D>
void has_unit_gradients(const Add<D>& add) {
  const Values now = values(system_of<D>(add), general_state<D>());
  // A norm and a division, of D components each: about 4 D roundings.
  const double round_off = 4.0 * D * std::numeric_limits<double>::epsilon();
  for (Eigen::Index r = 0; r < now.W.rows(); ++r) {
    int acted_on = 0;
    for (Eigen::Index p = 0; p < 2; ++p) {
      const double length = now.W.row(r).segment(p * D, D).norm();
      if (length == 0.0) continue;
      ++acted_on;
      EXPECT_NEAR(length, 1.0, round_off) << "row " << r << ", particle " << p;
    }
    EXPECT_GT(acted_on, 0);
  }
}

/// Moved together with its particles, a constraint has the same residual, and its force on each rotates with
/// it. (Rows may mix among themselves, as those of Coincident do: what is compared is lengths of g and gamma,
/// and the space of forces W^T W.)
template <int D>
void does_not_depend_on_the_place(const Add<D>& add) {
  const Placement<D> there = elsewhere<D>();
  State moved = general_state<D>();
  for (Eigen::Index p = 0; p < 2; ++p) {
    moved.q.segment<D>(p * D) = there.turn * moved.q.segment<D>(p * D) + eigen(there.shift);
    moved.v.segment<D>(p * D) = there.turn * moved.v.segment<D>(p * D);
  }
  Eigen::MatrixXd turn = Eigen::MatrixXd::Zero(2 * D, 2 * D);
  turn.topLeftCorner<D, D>() = turn.bottomRightCorner<D, D>() = there.turn;

  const Values here = values(system_of<D>(add), general_state<D>());
  const Values now = values(system_of<D>(add, there), moved);
  // Some 30 roundings of numbers up to 10, magnified by derivatives of size up to 10.
  const double round_off = 3000.0 * std::numeric_limits<double>::epsilon();
  EXPECT_NEAR(now.g.norm(), here.g.norm(), round_off);
  EXPECT_NEAR(now.psi.norm(), here.psi.norm(), round_off);
  EXPECT_NEAR(now.gamma.norm(), here.gamma.norm(), round_off);
  EXPECT_LE((now.W.transpose() * now.W - turn * here.W.transpose() * here.W * turn.transpose())
                .cwiseAbs()
                .maxCoeff(),
            round_off);
}

template <int D>
void put_under(const std::string& law, const std::string& type, void (*check)(const Add<D>&),
               const Add<D>& add) {
  register_test("EveryConstraint", law + "/" + type, [=] { check(add); });
}

}  // namespace

template <int D>
void any(const std::string& type, const Add<D>& add) {
  put_under<D>("DifferentiatesItsEquation", type, differentiates_its_equation<D>, add);
  put_under<D>("GivesTheSameBitsTwice", type, gives_the_same_bits_twice<D>, add);
}

template <int D>
void invariant(const std::string& type, const Add<D>& add) {
  any<D>(type, add);
  put_under<D>("DoesNotDependOnThePlace", type, does_not_depend_on_the_place<D>, add);
}

template <int D>
void geometric(const std::string& type, const Add<D>& add) {
  invariant<D>(type, add);
  put_under<D>("HasUnitGradients", type, has_unit_gradients<D>, add);
}

template void any<2>(const std::string&, const Add<2>&);
template void any<3>(const std::string&, const Add<3>&);
template void invariant<2>(const std::string&, const Add<2>&);
template void invariant<3>(const std::string&, const Add<3>&);
template void geometric<2>(const std::string&, const Add<2>&);
template void geometric<3>(const std::string&, const Add<3>&);

}  // namespace dalembert::laws
