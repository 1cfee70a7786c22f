#include "dalembert/solvers/linear/saddle.h"

#include "../equations.h"
#include <dalembert/constraints/compliant.h>
#include <dalembert/constraints/distance.h>
#include <dalembert/constraints/nonholonomic.h>
#include <dalembert/core/scene/scene.h>
#include <dalembert/solvers/ida/newton_matrix.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dalembert::saddle_test {
namespace {

/// A truss of rods in a row of triangles, masses from 0.1 to 10: S has fill and no natural order.
Scene<2> truss(int triangles) {
  Scene<2> scene("truss");
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-1.0, 1.0);
  std::vector<Particle<2>> p;
  for (int i = 0; i < triangles + 2; ++i) {
    p.push_back(scene.add_particle(
        {.mass = std::pow(10.0, exponent(random)), .position = {0.5 * i, i % 2 == 0 ? 0.0 : 0.8}}));
  }
  std::vector<std::pair<std::size_t, std::size_t>> rods;
  for (std::size_t i = 0; i + 1 < p.size(); ++i) rods.push_back({i, i + 1});
  for (std::size_t i = 0; i + 2 < p.size(); ++i) rods.push_back({i, i + 2});
  std::shuffle(rods.begin(), rods.end(), random);
  for (const auto& [a, b] : rods) {
    const bool level = b == a + 2;
    scene.add(Distance{p[a], p[b], level ? 1.0 : std::hypot(0.5, 0.8)});
  }
  return scene;
}

struct Prepared {
  explicit Prepared(const Scene<2>& scene)
      : system(scene.system()), rows(all_rows(system)), e(system.evaluation()) {
    system.evaluate({0.0, scene.initial_positions(), scene.initial_velocities()}, e);
  }
  System system;
  ActiveRows rows;
  System::Evaluation e;
};

std::vector<double> random_numbers(int count) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<double> x(static_cast<std::size_t>(count));
  for (double& y : x) y = number(random);
  return x;
}

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Against a dense solve. Either solution is good to round-off times condition, through the Schur complement
/// times its square.
template <class Matrix>
void expect_solves(Matrix& matrix, const SaddleValues& values, const Eigen::MatrixXd& K) {
  const std::vector<double> b = random_numbers(static_cast<int>(K.rows()));
  const Eigen::VectorXd expected = K.fullPivLu().solve(vector(b));
  const Eigen::VectorXd singular = K.jacobiSvd().singularValues();
  const double condition = singular[0] / singular[singular.size() - 1];
  const bool whole = values.blocks() != SaddleValues::Blocks::symmetric;

  ASSERT_TRUE(matrix.factorise(values));
  std::vector<double> x = b;
  matrix.solve(x);
  const double bound =
      epsilon * condition * (whole ? 1.0 : condition) * expected.norm() * static_cast<double>(K.rows());
  EXPECT_LT((vector(x) - expected).norm(), bound);
}

/// [M -W^T; W 0]
Eigen::MatrixXd symmetric_matrix(const Prepared& p) {
  const Eigen::Index n = index(p.system.coordinates()), m = index(p.system.rows());
  const Eigen::MatrixXd W = by_rows(p.system, p.e.w);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n + m, n + m);
  K.topLeftCorner(n, n) = vector(p.system.masses()).asDiagonal();
  K.topRightCorner(n, m) = -W.transpose();
  K.bottomLeftCorner(m, n) = W;
  return K;
}

template <class Matrix>
void expect_solves(Matrix& matrix, const Prepared& p) {
  expect_solves(matrix, {.w = p.e.w}, symmetric_matrix(p));
}

TEST(SchurComplement, SolvesLikeADenseMatrix) {
  const Prepared p(truss(12));
  const ComplementPattern pattern(p.system, p.rows.rows);
  SchurComplement schur(pattern);
  expect_solves(schur, p);
}

TEST(SchurComplement, SolvesForALoneConstraint) {
  Scene<2> scene;
  const auto bob = scene.add_particle({.mass = 2.0, .position = {0.6, -0.8}});
  scene.add(Distance{Fixed<2>{{0.0, 0.0}}, bob, 1.0});
  const Prepared p(scene);
  const ComplementPattern pattern(p.system, p.rows.rows);
  SchurComplement schur(pattern);
  expect_solves(schur, p);
}

TEST(SchurComplement, WorksWithSomeOfTheRowsOnly) {
  const Prepared p(truss(3));
  const std::vector<std::size_t> rows{1, 3, 4};
  const ComplementPattern pattern(p.system, rows);
  SchurComplement schur(pattern);
  ASSERT_TRUE(schur.factorise({.w = p.e.w}));
  const auto n = static_cast<int>(p.system.coordinates());
  std::vector<double> x = random_numbers(n + 3);
  const std::vector<double> b = x;
  schur.solve(x);
  const Eigen::MatrixXd W = by_rows(p.system, p.e.w);
  for (int r = 0; r < 3; ++r) {
    const double reached =
        W.row(index(rows[static_cast<std::size_t>(r)])).dot(Eigen::Map<Eigen::VectorXd>(x.data(), n));
    EXPECT_NEAR(reached, b[static_cast<std::size_t>(n + r)], 1e-13);  // round-off, 4 terms of size 10
  }
}

/// Two rods between the same points: the second pivot of S is round-off.
TEST(SchurComplement, RecognisesDependentRows) {
  Scene<2> scene;
  const auto a = scene.add_particle({.mass = 1.0, .position = {0.0, 0.0}});
  const auto b = scene.add_particle({.mass = 3.0, .position = {0.3, 0.4}});
  scene.add(Distance{a, b, 0.5}, "one");
  scene.add(Distance{a, b, 0.5}, "the same");
  const Prepared p(scene);
  const ComplementPattern pattern(p.system, p.rows.rows);
  SchurComplement schur(pattern);
  EXPECT_FALSE(schur.factorise({.w = p.e.w}));
}

/// Two rods from a bob to pivots that stand an angle of 1e-6 apart: sin^2 = 1e-12 is far above
/// round-off, but S alone would lose 12 of 16 digits. (The dense check is a residual, since the
/// solution itself is ill-conditioned.)
TEST(SaddleMatrix, TakesTheWholeMatrixWhereRowsNearlyCoincide) {
  Scene<2> scene;
  const double angle = 1e-6;
  const auto bob = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  scene.add(Distance{Fixed<2>{{0.0, 0.0}}, bob, 1.0});
  const Vec<2> pivot{1.0 - std::cos(angle), std::sin(angle)};
  scene.add(Distance{Fixed<2>{pivot}, bob, 1.0});
  const Prepared p(scene);
  SaddleMatrix saddle(Problem(p.system).pattern(p.rows.rows));
  ASSERT_TRUE(saddle.factorise({.w = p.e.w}));
  std::vector<double> x{0.0, 0.0, 0.3, 0.7};
  saddle.solve(x);
  const Eigen::MatrixXd W = by_rows(p.system, p.e.w);
  const Eigen::Vector2d dq(x[0], x[1]);
  // |dq| = 4e5: a residual of a few units of its round-off. Through S alone it would be 1e-4.
  EXPECT_NEAR(W.row(0).dot(dq), 0.3, 1e-9);
  EXPECT_NEAR(W.row(1).dot(dq), 0.7, 1e-9);
}

/// 60 rods from one hub: S is full, the whole matrix sparse.
TEST(SaddleMatrix, TakesTheWholeMatrixWhereTheComplementIsFull) {
  Scene<2> scene;
  const auto hub = scene.add_particle({.mass = 1.0, .position = {0.0, 0.0}});
  for (int i = 0; i < 60; ++i) {
    const double phi = 0.1 * i;
    const auto p = scene.add_particle({.mass = 0.1, .position = {std::cos(phi), std::sin(phi)}});
    scene.add(Distance{hub, p, 1.0});
  }
  const Prepared p(scene);
  SaddleMatrix saddle(Problem(p.system).pattern(p.rows.rows));
  EXPECT_STREQ(saddle.method(), "KLU");
  const Prepared few(truss(4));
  EXPECT_STREQ(SaddleMatrix(Problem(few.system).pattern(few.rows.rows)).method(), "LDL");
  expect_solves(saddle, p);
}

/// All that may stand in it, in turn, against a dense matrix put together from what the header says.
TEST(SaddleMatrix, SolvesWithWhateverBlocksItIsGiven) {
  Scene<2> scene;
  const auto a = scene.add_particle({.mass = 1.0, .position = {0.8, -0.5}, .velocity = {-0.3, 1.2}});
  const auto b = scene.add_particle({.mass = 3.0, .position = {0.4, 1.4}, .velocity = {0.7, 0.9}});
  const auto rod = scene.add(Distance{Fixed<2>{}, a, 1.0});
  scene.add(compliant(Distance{a, b, 1.5}, 0.1));
  scene.add(nonholonomic(points(b), [](auto r, auto v) { return v.y() - r.x() * v.x(); }));
  scene.add(
      friction_law(rod, points(b), [](auto lambda, auto, auto v) { return (-0.3 * lambda * v).eval(); }));
  scene.add(Spring{a, b, 7.0, 1.0});
  scene.add(Damper{a, b, 0.5});
  const Prepared p(scene);
  constexpr int n = 4, m = 3;
  const Instant at{0.0, scene.initial_positions(), scene.initial_velocities()};
  auto d = p.system.linearisation();
  p.system.linearise(at, std::vector<double>{2.0, -3.0, 1.0}, d);
  const double s = 0.7, h = 0.4, k = 0.9;
  std::vector<double> diagonal(m, 0.0);
  for (std::size_t r = 0; r < m; ++r) {
    if (p.system.law(r).compliant()) diagonal[r] = s;
  }
  ASSERT_EQ(std::ranges::count(diagonal, s), 1);
  const std::vector<double> lower = random_numbers(static_cast<int>(p.e.w.size()));

  Eigen::MatrixXd symmetric = symmetric_matrix(p);
  symmetric.bottomRightCorner(m, m) = vector(diagonal).asDiagonal();
  Eigen::MatrixXd with_slope = symmetric;
  for (std::size_t i = 0; i < d.friction.size(); ++i) {
    const auto [coordinate, row] = p.system.forces().friction_pattern()[i];
    with_slope(index(coordinate), n + index(row)) -= d.friction[i];
  }
  Eigen::MatrixXd all = with_slope;
  all.topLeftCorner(n, n) -= h * by_entries(n, p.system.stiffness_pattern(), d.stiffness) +
                             k * by_entries(n, p.system.forces().damping_pattern(), d.damping);
  all.bottomLeftCorner(m, n) = by_rows(p.system, lower);

  SaddleMatrix matrix(Problem(p.system).pattern(p.rows.rows));
  for (int again = 0; again < 2; ++again) {
    SaddleValues values{.w = p.e.w, .s = diagonal};
    expect_solves(matrix, values, symmetric);
    values.slope = d.friction;
    expect_solves(matrix, values, with_slope);
    values.lower = lower;
    values.forces = &d;
    values.h = h;
    values.d = k;
    expect_solves(matrix, values, all);
  }
}

/// The soft Newton solve satisfies (1) to (4) of NewtonMatrix with H = D = 0 exactly: checked by
/// inserting it.
TEST(NewtonMatrix, SolvesItsEquationsWithoutSoftForces) {
  const Scene<2> scene = truss(5);
  Prepared p(scene);
  std::vector<double> v = random_numbers(static_cast<int>(p.system.coordinates()));
  p.system.evaluate({0.0, scene.initial_positions(), v}, p.e);
  const auto n = static_cast<int>(p.system.coordinates()), m = static_cast<int>(p.system.rows());
  const std::vector<double> lambda(static_cast<std::size_t>(m), 0.0);  // so that H = 0
  const double c = 50.0;
  NewtonMatrix newton(Problem(p.system), p.rows, 1.0);
  ASSERT_TRUE(newton.factorise({0.0, scene.initial_positions(), v}, p.e, lambda, c));
  ASSERT_TRUE(newton.soft());
  const std::vector<double> b = random_numbers(2 * n + 2 * m);
  std::vector<double> x = b;
  newton.solve(c, x);

  auto linear = p.system.linearisation();
  p.system.linearise({0.0, scene.initial_positions(), v}, lambda, linear);
  const Eigen::MatrixXd W = by_rows(p.system, p.e.w);
  const Eigen::MatrixXd psi_q = by_rows(p.system, linear.psi_q);
  const Eigen::Map<Eigen::VectorXd> dq(x.data(), n), dv(x.data() + n, n), dlambda(x.data() + 2 * n, m),
      dmu(x.data() + 2 * n + m, m);
  const Eigen::Map<const Eigen::VectorXd> b1(b.data(), n), b2(b.data() + n, n), b3(b.data() + 2 * n, m),
      b4(b.data() + 2 * n + m, m);
  const Eigen::Map<const Eigen::VectorXd> M(p.system.masses().data(), n);
  // Round-off of terms up to c^2 |x| ~ 1e5, times the condition of S.
  const double bound = 1e-8;
  EXPECT_LT((M.cwiseProduct(dv - c * dq) + W.transpose() * dmu - b1).norm(), bound);
  EXPECT_LT((-c * M.cwiseProduct(dv) + W.transpose() * dlambda - b2).norm(), bound);
  EXPECT_LT((psi_q * dq + W * dv - b3).norm(), bound);
  EXPECT_LT((W * dq - b4).norm(), bound);
}

TEST(NewtonMatrix, KeepsStiffForces) {
  Scene<2> scene;
  const auto a = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}});
  const auto b = scene.add_particle({.mass = 1.0, .position = {2.0, 0.0}});
  scene.add(Distance{Fixed<2>{{0.0, 0.0}}, a, 1.0});
  scene.add(Spring{a, b, 1e6, 1.0});
  const Prepared p(scene);
  NewtonMatrix newton(Problem(p.system), p.rows, 1.0);
  const std::vector<double> lambda{0.0};
  const Instant at{0.0, scene.initial_positions(), scene.initial_velocities()};
  ASSERT_TRUE(newton.factorise(at, p.e, lambda, 100.0));  // k/(m c^2) = 100
  EXPECT_FALSE(newton.soft());
  ASSERT_TRUE(newton.factorise(at, p.e, lambda, 1e5));  // 1e-4, but 10 in relation to the time: k T/(m c)
  EXPECT_FALSE(newton.soft());
  ASSERT_TRUE(newton.factorise(at, p.e, lambda, 1e8));  // 0.01
  EXPECT_TRUE(newton.soft());
}

}  // namespace
}  // namespace dalembert::saddle_test
