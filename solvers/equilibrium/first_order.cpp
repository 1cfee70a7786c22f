#include "dalembert/solvers/equilibrium/first_order.h"

#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/linear/products.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

namespace dalembert {

namespace {

using Eigen::Index;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// The equations (1) of the header, and for each number the size of the terms that it is the sum of.
struct FirstOrder {
  Matrix P, matrix, size;
  double known;  ///< the part of that to which it is known
};

FirstOrder first_order(const Tangent& t) {
  const Index d = t.K.rows();
  Matrix P = Matrix::Identity(d, d), lifted = Matrix::Zero(d, d);  // lifted: B^+ E
  Matrix lifted_terms = Matrix::Zero(d, d);
  if (!t.B.isZero(0.0)) {
    lifted = dense::least_squares(t.B, t.E, rank_threshold);
    const Matrix inverse =
        dense::least_squares(t.B, Matrix::Identity(t.B.rows(), t.B.rows()), rank_threshold);
    lifted_terms = dense::sizes(inverse) * t.E_terms;
    P = orthogonal_complement(t.B.transpose());
  }
  const Index c = P.cols();
  const Matrix p = dense::sizes(P), C = dense::sizes(t.C);
  Matrix matrix(d + c, d + c), size(d + c, d + c);
  matrix.topRows(d) = dense::beside(-lifted, P);
  matrix.bottomRows(c) =
      dense::beside(P.transpose() * Matrix(t.C * lifted - t.K), -dense::restricted(P, t.C));
  size.topRows(d) = dense::beside(lifted_terms, p);
  size.bottomRows(c) =
      dense::beside(p.transpose() * Matrix(C * lifted_terms + t.K_terms), dense::restricted(p, C));
  return {std::move(P), std::move(matrix), std::move(size), t.known()};
}

/// A basis of A x = 0, as far as can be told: each row is measured by what its numbers are sums of, as a row
/// of round-off would look like any other by its own length.
Matrix kernel(const Matrix& A, const Matrix& size, double known) {
  Vector scale = size.rowwise().maxCoeff();
  for (double& x : scale) x = x > 0.0 ? 1.0 / x : 1.0;
  return dense::kernel_within(scale.asDiagonal() * A, known);
}

/// A basis of the states at rest: P^T K z = 0, E z = 0.
Matrix states_at_rest(const Tangent& t, const FirstOrder& f) {
  const Matrix p = dense::sizes(f.P);
  return kernel(dense::below(f.P.transpose() * t.K, t.E), dense::below(p.transpose() * t.K_terms, t.E_terms),
                t.known());
}

/// Orthonormal bases of the span of independent columns, and of its complement.
std::pair<Matrix, Matrix> split(const Matrix& columns) {
  Matrix rest = orthogonal_complement(columns, of_full_rank);
  return {orthogonal_complement(rest), std::move(rest)};
}

/// A matrix deflated by its known zero eigenvalues: those of the states at rest, and of the motions that go
/// along them for ever: x with A x among those known so far, at most as many as the last time. (A heading
/// moves a skate sideways, and nothing turns it back.)
struct Deflated {
  Matrix zeros, rest;  ///< orthonormal; span(zeros) is invariant

  Deflated(const FirstOrder& f, const Matrix& at_rest) {
    std::tie(zeros, rest) = split(at_rest);
    for (Index last = at_rest.cols(); last > 0 && rest.cols() > 0;) {
      const Matrix further =
          kernel(dense::restricted(rest, f.matrix), dense::restricted(dense::sizes(rest), f.size), f.known);
      last = std::min(further.cols(), last);
      const auto [steady, others] = split(further.leftCols(last));
      zeros = dense::beside(zeros, rest * steady);
      rest = rest * others;
    }
  }
  /// The eigenvector of A from one, y, of rest^T A rest.
  [[nodiscard]] Eigen::VectorXcd lift(const Matrix& A, std::complex<double> s,
                                      const Eigen::VectorXcd& y) const {
    const Eigen::VectorXcd x = rest * y;
    if (zeros.cols() == 0) return x;
    Eigen::MatrixXcd T = -dense::restricted(zeros, A).cast<std::complex<double>>();
    T.diagonal().array() += s;
    const Matrix across = zeros.transpose() * A;
    return x + zeros * dense::solve(T, across * x);
  }
};

/// V/2 of every two of some vibrations: with energies in other frames, see `steadied`.
struct Forms {
  Eigen::MatrixXcd energy, momentum;
  Vector size;  ///< of the terms of each one's own energy
};

Forms forms(const Tangent& t, const Matrix& beta, std::span<const Solution* const> some) {
  const auto m = static_cast<Index>(some.size());
  Eigen::MatrixXcd Z(t.K.rows(), m);
  Eigen::VectorXcd s(m);
  for (Index k = 0; k < m; ++k) {
    Z.col(k) = some[static_cast<std::size_t>(k)]->z;
    s[k] = some[static_cast<std::size_t>(k)]->s;
  }
  const Eigen::MatrixXcd rates = Z * s.asDiagonal(), turned = beta * Z,
                         cross = dense::adjoint_product(rates, turned);
  Forms f{dense::adjoint_product(rates, rates) + dense::adjoint_product(Z, t.K * Z),
          cross + cross.adjoint() - dense::adjoint_product(Z, t.C * turned), Vector(m)};
  const Matrix sizes = Z.cwiseAbs(), terms = dense::sizes(t.K) * sizes;
  for (Index k = 0; k < m; ++k) f.size[k] = rates.col(k).squaredNorm() + sizes.col(k).dot(terms.col(k));
  return f;
}

/// Whether a Hermitian form is > 0, of which each number is a share of its terms.
bool is_definite(const Eigen::MatrixXcd& A) {
  const Index m = A.rows();
  Matrix both(2 * m, 2 * m);
  both << A.real(), -A.imag(), A.imag(), A.real();
  return dense::symmetric_eigen(both).values.minCoeff() > rank_threshold;
}

/// A number c for which H + c J > 0 of each vibration, if there is one.
std::optional<double> between(const Forms& f) {
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  for (Index k = 0; k < f.size.size(); ++k) {
    const double H = f.energy(k, k).real(), J = f.momentum(k, k).real();
    if (J > 0.0) low = std::max(low, -H / J);
    if (J < 0.0) high = std::min(high, -H / J);
    if (J == 0.0 && !(H > 0.0)) return std::nullopt;
  }
  if (!(low < high)) return std::nullopt;
  if (std::isfinite(low) && std::isfinite(high)) return 0.5 * (low + high);
  if (std::isfinite(low)) return low + std::max(1.0, std::abs(low));
  return std::isfinite(high) ? high - std::max(1.0, std::abs(high)) : 0.0;
}

/// Whether a symmetry that leaves the state as it is has a momentum that the small motions conserve: by
/// beta skew that commutes with C skew and K symmetric, of z'' + C z' + K z = 0,
///
///   J = z'.beta z - z.C beta z/2                                                                     (2)
///
/// (A beta that is no symmetry of the numbers is not used.)
bool conserves(const Tangent& t, const Matrix& beta) {
  const auto same = [&](const Matrix& x, const Matrix& y, double size) {
    return (x - y).norm() <= rank_threshold * size;
  };
  const double b = beta.norm();
  return same(beta, -beta.transpose(), b) && same(t.C, -t.C.transpose(), t.C.norm()) &&
         same(beta * t.C, t.C * beta, b * t.C.norm()) &&
         same(beta * t.K, t.K * beta, b * (t.K.norm() + t.zero() / rank_threshold));
}

/// Energies H + c J in other frames in which the state rests as well: conserved, too. A top that sleeps has H
/// < 0 in one of its vibrations, and above its critical spin H + c J > 0 in both for some c.
void steady_by_momenta(const Tangent& t, std::vector<Solution>& all) {
  if (!has_energy(t)) return;
  std::vector<Solution*> open;
  for (Solution& x : all)
    if (std::abs(x.s.real()) <= x.error) open.push_back(&x);
  if (std::ranges::all_of(open, &Solution::positive)) return;
  const std::vector<const Solution*> some(open.begin(), open.end());
  for (const Matrix& beta : t.fixing) {
    if (!conserves(t, beta)) continue;
    const Forms f = forms(t, beta, some);
    const auto c = between(f);
    if (!c) continue;
    Vector scale(f.size.size());
    bool known = true;
    for (Index k = 0; k < scale.size(); ++k) {
      const double terms = f.size[k] + std::abs(*c) * std::abs(f.momentum(k, k).real());
      const double share = some[static_cast<std::size_t>(k)]->z.squaredNorm() * t.zero() / terms;
      known = known && share <= rank_threshold;
      scale[k] = 1.0 / std::sqrt(terms);
    }
    const Eigen::MatrixXcd V = f.energy + *c * f.momentum;
    if (!known || !is_definite(scale.asDiagonal() * V * scale.asDiagonal())) continue;
    for (Solution* x : open) x->positive = true;
    return;
  }
}

}  // namespace

bool has_energy(const Tangent& t) {
  if (!t.symmetric || (t.E.size() > 0 && t.E.cwiseAbs().maxCoeff() > t.zero_of_rows())) return false;
  Matrix D = onto(Matrix::Identity(t.C.rows(), t.C.rows()), t.C, t.known());
  D = ((D + D.transpose()) / 2).eval();
  D = (D.array().abs() > t.known() * (t.C.cwiseAbs() + t.C.transpose().cwiseAbs()).array()).select(D, 0.0);
  Vector scale(D.rows());
  for (Index i = 0; i < D.rows(); ++i) {
    if (D(i, i) < 0.0 || (D(i, i) == 0.0 && !D.row(i).isZero(0.0))) return false;
    scale[i] = D(i, i) > 0.0 ? 1.0 / std::sqrt(D(i, i)) : 0.0;
  }
  const Vector shares = dense::symmetric_eigen(scale.asDiagonal() * D * scale.asDiagonal()).values;
  return D.rows() == 0 || shares.minCoeff() >= -t.known();
}

Solutions solutions(Tangent t) {
  /// Of each term of the matrix and each step of the QR algorithm, in units of round-off of the largest.
  constexpr double backward = 10.0;
  const double Omega = t.scale_time();
  const FirstOrder f = first_order(t);
  Solutions found{states_at_rest(t, f), {}};
  Matrix at_rest = found.at_rest;
  at_rest.conservativeResizeLike(Matrix::Zero(f.matrix.rows(), at_rest.cols()));
  const Deflated deflated(f, at_rest);
  const Matrix A = dense::restricted(deflated.rest, f.matrix);
  if (A.size() == 0) return found;
  const auto [values, right] = dense::complex_eigen(A);
  const Eigen::MatrixXcd left = dense::inverse(right);
  const double change = backward * static_cast<double>(A.rows()) * t.roundings * epsilon * f.size.norm();
  for (Index k = 0; k < A.rows(); ++k) {
    const std::complex<double> s = values[k];
    if (s.imag() < 0.0) continue;
    // First-order perturbation: |ds| <= |dA| / |y^H x| for left and right eigenvectors of length 1.
    const double condition = left.row(k).norm() * right.col(k).norm();
    const double error =
        change * (std::isfinite(condition) ? condition : std::numeric_limits<double>::infinity());
    const Eigen::VectorXcd z = deflated.lift(f.matrix, s, right.col(k)).head(t.K.rows());
    const double kinetic = std::norm(s) * z.squaredNorm();
    const double energy = kinetic + z.dot(t.K * z).real();
    const Vector size = z.cwiseAbs();
    const double unknown = t.known() * size.dot(t.K_terms * size);
    found.others.push_back({s, error, z, energy > rank_threshold * kinetic + unknown});
  }
  steady_by_momenta(t, found.others);
  for (Solution& x : found.others) {
    x.s *= Omega;
    x.error *= Omega;
  }
  return found;
}

}  // namespace dalembert
