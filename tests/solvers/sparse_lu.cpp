#include <dalembert/solvers/linear/klu.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <limits>

namespace dalembert::sparse_lu_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

using Entry = LuPattern::Entry;

/// All entries of a full matrix, row by row.
std::vector<Entry> full(std::size_t size) {
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) entries.push_back({i, j});
  }
  return entries;
}

void set(SparseLU& lu, const Eigen::MatrixXd& a) {
  lu.set_zero();
  std::size_t k = 0;
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    for (Eigen::Index j = 0; j < a.cols(); ++j) lu.add(k++, a(i, j));
  }
}

Eigen::VectorXd solution(SparseLU& lu, Eigen::VectorXd b) {
  lu.solve({b.data(), static_cast<std::size_t>(b.size())});
  return b;
}

Eigen::MatrixXd general() {
  return (Eigen::Matrix4d() << 4.0, 1.0, 0.5, -1.0, 2.0, 5.0, 1.0, 0.3, -0.7, 0.1, 3.0, 1.0, 1.0, 2.0, -1.0,
          6.0)
      .finished();
}

/// Gaussian elimination with pivots is backward stable: |A x - b| <= c n eps |A| |x|.
void expect_solved(const Eigen::MatrixXd& a, const Eigen::VectorXd& x, const Eigen::VectorXd& b) {
  const auto n = static_cast<double>(a.rows());
  EXPECT_LE((a * x - b).lpNorm<Eigen::Infinity>(), 4.0 * n * epsilon * a.norm() * x.norm());
}

TEST(SparseLU, Solves) {
  const LuPattern pattern(4, full(4));
  SparseLU lu(pattern);
  set(lu, general());
  ASSERT_TRUE(lu.factorise());
  const Eigen::Vector4d b(1.0, 2.0, 3.0, 4.0);
  expect_solved(general(), solution(lu, b), b);
}

TEST(SparseLU, EntriesOfOnePlaceAddUp) {
  const std::vector<Entry> entries{{0, 0}, {1, 1}, {0, 0}, {0, 1}};
  const LuPattern pattern(2, entries);
  SparseLU lu(pattern);
  lu.set_zero();
  lu.add(0, 1.5);
  lu.add(1, 4.0);
  lu.add(2, 0.5);
  lu.add(3, 1.0);
  ASSERT_TRUE(lu.factorise());
  EXPECT_EQ(solution(lu, Eigen::Vector2d(3.0, 4.0)), Eigen::Vector2d(1.0, 1.0));
}

TEST(SparseLU, ARefactorisationIsAsGoodAsAFreshOne) {
  const LuPattern pattern(4, full(4));
  SparseLU reused(pattern);
  set(reused, general());
  ASSERT_TRUE(reused.factorise());
  const Eigen::MatrixXd next = general() + Eigen::MatrixXd::Constant(4, 4, 0.01);
  set(reused, next);
  ASSERT_TRUE(reused.factorise());
  const Eigen::Vector4d b(1.0, 2.0, 3.0, 4.0);
  expect_solved(next, solution(reused, b), b);
}

TEST(SparseLU, MatricesOfOnePatternHaveValuesAndFactorsOfTheirOwn) {
  const LuPattern pattern(4, full(4));
  SparseLU one(pattern), other(pattern);
  const Eigen::MatrixXd transposed = general().transpose();
  set(one, general());
  set(other, transposed);
  ASSERT_TRUE(one.factorise());
  ASSERT_TRUE(other.factorise());
  const Eigen::Vector4d b(1.0, 2.0, 3.0, 4.0);
  expect_solved(general(), solution(one, b), b);
  expect_solved(transposed, solution(other, b), b);
}

// The pivots of the first matrix stand on entries that vanish in the second.
TEST(SparseLU, PivotsAgainWhenThePivotsHaveBecomeUnstable) {
  const LuPattern pattern(2, full(2));
  SparseLU lu(pattern);
  set(lu, (Eigen::Matrix2d() << 1.0, 0.1, 0.1, 1.0).finished());
  ASSERT_TRUE(lu.factorise());
  const Eigen::Matrix2d next = (Eigen::Matrix2d() << 1e-14, 1.0, 1.0, 1e-14).finished();
  set(lu, next);
  ASSERT_TRUE(lu.factorise());
  const Eigen::Vector2d b(1.0, 2.0);
  expect_solved(next, solution(lu, b), b);
}

TEST(SparseLU, RecognisesASingularMatrix) {
  const LuPattern pattern(2, full(2));
  SparseLU lu(pattern);
  set(lu, (Eigen::Matrix2d() << 1.0, 2.0, 2.0, 4.0).finished());
  EXPECT_FALSE(lu.factorise());
}

TEST(SparseLU, RecognisesAMatrixThatIsSingularByItsPattern) {
  const std::vector<Entry> entries{{0, 0}, {1, 0}};
  const LuPattern pattern(2, entries);
  SparseLU lu(pattern);
  lu.set_zero();
  lu.add(0, 1.0);
  lu.add(1, 1.0);
  EXPECT_FALSE(lu.factorise());
}

// Rows in any order: a cyclic shift of four changes the sign, two exchanges do not; nor does KLU's own
// choice of pivots, blocks (a triangle) and scales.
TEST(SparseLU, KnowsTheSignOfItsDeterminant) {
  const Eigen::Matrix4d triangle = general().triangularView<Eigen::Upper>();
  for (const Eigen::Matrix4d& a : {Eigen::Matrix4d(general()), triangle}) {
    for (const auto& order : {Eigen::Vector4i(0, 1, 2, 3), Eigen::Vector4i(1, 2, 3, 0),
                              Eigen::Vector4i(1, 0, 3, 2), Eigen::Vector4i(2, 1, 0, 3)}) {
      for (const double scale : {1.0, -1e6}) {
        Eigen::Matrix4d b;
        for (int i = 0; i < 4; ++i) b.row(i) = a.row(order[i]);
        b.row(2) *= scale;
        const LuPattern pattern(4, full(4));
        SparseLU lu(pattern);
        set(lu, b);
        ASSERT_TRUE(lu.factorise());
        EXPECT_EQ(lu.sign_of_determinant(), b.determinant() > 0.0 ? 1 : -1) << b;
        set(lu, 2.0 * b);
        ASSERT_TRUE(lu.factorise());  // with the same pivots
        EXPECT_EQ(lu.sign_of_determinant(), b.determinant() > 0.0 ? 1 : -1) << b;
      }
    }
  }
}

TEST(SparseLU, RecoversFromASingularMatrix) {
  const LuPattern pattern(4, full(4));
  SparseLU lu(pattern);
  set(lu, general());
  ASSERT_TRUE(lu.factorise());
  set(lu, Eigen::MatrixXd::Ones(4, 4));
  EXPECT_FALSE(lu.factorise());
  set(lu, general());
  ASSERT_TRUE(lu.factorise());
  const Eigen::Vector4d b(1.0, 2.0, 3.0, 4.0);
  expect_solved(general(), solution(lu, b), b);
}

}  // namespace
}  // namespace dalembert::sparse_lu_test
