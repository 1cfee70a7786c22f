#include "dalembert/solvers/equilibrium/tangent_modes.h"

#include <dalembert/core/analysis/islands.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/mass_metric.h>
#include <dalembert/solvers/linear/dense.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <tuple>
#include <utility>

namespace dalembert {

namespace {

using Eigen::Index;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
constexpr double round_off_of_a_sum = roundings_of_a_sum * epsilon;

/// The problem (1) of the header for some coordinates, u = shapes z.
struct Tangent {
  std::size_t all;                       ///< coordinates of the scene
  std::vector<std::size_t> coordinates;  ///< these of them
  Matrix shapes;                         ///< M^-1/2 N
  Matrix K, C, B, E;
  bool symmetric;  ///< K
  Matrix metric;   ///< M^1/2 N
  double zero;     ///< round-off of K: of the terms that its numbers are sums of
};

/// What N^T X N sums, without signs.
Matrix summed(const Matrix& N, const Matrix& X) {
  return N.cwiseAbs().transpose() * X.cwiseAbs() * N.cwiseAbs();
}

/// N^T X N, with 0 for what is round-off of the summed terms.
Matrix onto(const Matrix& N, const Matrix& X) {
  const Matrix Y = N.transpose() * X * N;
  const Matrix size = summed(N, X);
  return (Y.array().abs() > round_off_of_a_sum * size.array()).select(Y, Matrix::Zero(Y.rows(), Y.cols()));
}

Tangent tangent(const System& system, const LinearTerms& terms, std::vector<std::size_t> coordinates,
                std::span<const std::size_t> rows) {
  const MassMetric metric(system, terms, coordinates, rows);
  const Matrix N = orthogonal_complement(metric.W.topRows(metric.holonomic).transpose());
  Matrix skew = Matrix(circulatory(terms, system.coordinates()));
  skew = skew(coordinates, coordinates).eval();
  skew = onto(N, metric.root.asDiagonal() * skew * metric.root.asDiagonal());
  const Index velocity_rows = metric.W.rows() - metric.holonomic;
  Tangent t{system.coordinates(),
            std::move(coordinates),
            metric.root.asDiagonal() * N,
            N.transpose() * metric.K * N,
            onto(N, metric.C),  // 0 where a guide takes up Coriolis forces
            metric.W.bottomRows(velocity_rows) * N,
            metric.E.bottomRows(velocity_rows) * N,
            skew.isZero(0.0),
            metric.root.cwiseInverse().asDiagonal() * N,
            N.cols() > 0 ? round_off_of_a_sum * summed(N, metric.K).maxCoeff() : 0.0};
  if (t.symmetric) t.K = ((t.K + t.K.transpose()) / 2).eval();
  if (t.K.size() > 0 && t.K.cwiseAbs().maxCoeff() <= t.zero) t.K.setZero();
  for (Index k = 0; k < velocity_rows; ++k)
    if (t.B.row(k).norm() < rank_threshold) t.B.row(k).setZero();  // dependent on holonomic rows
  return t;
}

/// Uncoupled parts of a scene are scenes of their own: what is small in one is not lost beside what is stiff
/// in another.
std::vector<Tangent> tangents(const System& system, const LinearTerms& terms) {
  const Islands parts = islands(system);
  std::vector<std::vector<std::size_t>> coordinates(parts.count), rows(parts.count);
  for (std::size_t i = 0; i < system.coordinates(); ++i) coordinates[parts.of_coordinate[i]].push_back(i);
  for (std::size_t r = 0; r < system.rows(); ++r) rows[parts.of_row(system, r)].push_back(r);
  std::vector<Tangent> all;
  for (std::size_t k = 0; k < parts.count; ++k)
    all.push_back(tangent(system, terms, std::move(coordinates[k]), rows[k]));
  return all;
}

/// Makes K and E zero along symmetries that leave the motion as it is, see `dense_modes`: those along which
/// they are no more than `rank_threshold` of their terms.
void rest_along(const Matrix& symmetric, Tangent& t) {
  if (symmetric.cols() == 0) return;
  const Matrix own = t.metric.transpose() * symmetric(t.coordinates, Eigen::all);
  if (own.isZero(0.0)) return;
  const Matrix Y = orthogonal_complement(orthogonal_complement(own));
  const double time = t.K.norm() > 0.0 ? 1.0 / std::sqrt(t.K.norm()) : 1.0;
  Matrix change(t.K.rows() + t.E.rows(), Y.cols());
  change << time * time * t.K * Y, time * t.E * Y;
  const auto [squares, vectors] = dense::symmetric_eigen(change.transpose() * change);
  const Index none =
      std::ranges::count_if(squares, [](double x) { return x <= rank_threshold * rank_threshold; });
  if (none == 0) return;
  const Matrix still = Y * vectors.leftCols(none);
  t.K -= t.K * still * still.transpose();
  t.E -= t.E * still * still.transpose();
  if (t.symmetric) t.K -= still * (still.transpose() * t.K).eval();
}

/// The shape in the system's coordinates, its largest number 1.
Mode mode(std::complex<double> eigenvalue, const Eigen::VectorXcd& z, const Tangent& t) {
  Eigen::VectorXcd u = t.shapes * z;
  Index largest = 0;
  (void)u.cwiseAbs().maxCoeff(&largest);
  u /= std::complex<double>(u[largest]);
  Mode found{eigenvalue, std::vector<std::complex<double>>(t.all), false};
  for (std::size_t k = 0; k < t.coordinates.size(); ++k)
    found.shape[t.coordinates[k]] = u[static_cast<Index>(k)];
  return found;
}

std::string grows(std::complex<double> s) {
  std::ostringstream text;
  text << "a mode of " << s.imag() << " rad/time grows as exp(" << s.real() << " t)";
  return text.str();
}

/// The verdict of all modes, with the cause that weighs most: of those that grow the one that grows fastest.
struct Verdict {
  Modes& found;
  double growth = 0.0;

  void grows_by(std::complex<double> s) {
    if (!(s.real() > growth)) return;
    growth = s.real();
    found.stability = Stability::unstable;
    found.reason = grows(s);
  }
  void leave_undecided(const std::string& reason) const {
    if (found.stability != Stability::stable) return;
    found.stability = Stability::undecided;
    found.reason = reason;
  }
};

/// K z = omega^2 z. What is within round-off of 0 counts as 0, to be decided by a finite motion.
void of_conservative(const Tangent& t, Verdict& verdict) {
  const auto [square, shapes] = dense::symmetric_eigen(t.K);
  for (Index k = 0; k < square.size(); ++k) {
    std::complex<double> s = std::sqrt(std::complex<double>(-square[k]));
    if (std::abs(square[k]) <= t.zero) s = 0.0;
    s = {std::abs(s.real()), std::abs(s.imag())};
    verdict.found.modes.push_back(mode(s, shapes.col(k).cast<std::complex<double>>(), t));
    verdict.grows_by(s);
  }
}

/// Scales time so that K, or without stiffness C and E, has norm 1; returns the frequency Omega of that unit.
double scale_time(Tangent& t) {
  double Omega = std::sqrt(t.K.norm());
  if (Omega == 0.0) Omega = std::max(t.C.norm(), t.E.norm());
  if (Omega == 0.0) return 1.0;
  t.K /= Omega * Omega;
  t.zero /= Omega * Omega;
  t.C /= Omega;
  t.E /= Omega;
  return Omega;
}

/// The equations (2) of the header, and for each number the size of the terms that it is the sum of.
struct FirstOrder {
  Matrix P, matrix, size;
};

FirstOrder first_order(const Tangent& t) {
  const Index d = t.K.rows();
  Matrix P = Matrix::Identity(d, d), lifted = Matrix::Zero(d, d);  // lifted: B^+ E
  if (!t.B.isZero(0.0)) {
    lifted = dense::least_squares(t.B, t.E, rank_threshold);
    P = orthogonal_complement(t.B.transpose());
  }
  const Index c = P.cols();
  Matrix matrix(d + c, d + c), size(d + c, d + c);
  matrix << -lifted, P, P.transpose() * (t.C * lifted - t.K), -P.transpose() * t.C * P;
  const Matrix p = P.cwiseAbs(), l = Matrix::Constant(d, d, lifted.norm());
  size << l, p, p.transpose() * (t.C.cwiseAbs() * l + Matrix::Constant(d, d, t.K.norm())),
      p.transpose() * t.C.cwiseAbs() * p;
  return {std::move(P), std::move(matrix), std::move(size)};
}

/// A basis of A x = 0, as far as can be told: each row is measured by what its numbers are sums of, as a row
/// of round-off would look like any other by its own length.
Matrix kernel(const Matrix& A, const Matrix& size) {
  Vector scale = size.rowwise().maxCoeff();
  for (double& x : scale) x = x > 0.0 ? 1.0 / x : 1.0;
  return dense::kernel(scale.asDiagonal() * A, round_off_of_a_sum);
}

/// A basis of the states at rest: P^T K z = 0, E z = 0. (Not by rows of unit length: those of K may be
/// round-off.)
Matrix states_at_rest(const Tangent& t, const FirstOrder& f) {
  Matrix S(f.P.cols() + t.E.rows(), t.K.cols());
  S << f.P.transpose() * t.K, t.E;
  return dense::kernel(S, round_off_of_a_sum);
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
      const Matrix again = rest.transpose() * f.matrix * rest,
                   size = rest.cwiseAbs().transpose() * f.size * rest.cwiseAbs();
      const Matrix further = kernel(again, size);
      last = std::min(further.cols(), last);
      const auto [steady, others] = split(further.leftCols(last));
      Matrix all(zeros.rows(), zeros.cols() + steady.cols());
      all << zeros, rest * steady;
      zeros = std::move(all);
      rest = (rest * others).eval();
    }
  }
  /// The eigenvector of A from one, y, of rest^T A rest.
  [[nodiscard]] Eigen::VectorXcd lift(const Matrix& A, std::complex<double> s,
                                      const Eigen::VectorXcd& y) const {
    const Eigen::VectorXcd x = rest * y;
    if (zeros.cols() == 0) return x;
    Eigen::MatrixXcd T = -(zeros.transpose() * A * zeros).cast<std::complex<double>>();
    T.diagonal().array() += s;
    return x + zeros * dense::solve(T, (zeros.transpose() * A) * x);
  }
};

/// Whether an energy conserved or dissipated decides stability: K symmetric, constraints that do no work, and
/// C positive semi-definite. Each coordinate is scaled by its own damping, so that a strong damper hides no
/// weak negative one.
bool has_energy(const Tangent& t) {
  if (!t.symmetric || t.E.norm() > round_off_of_a_sum) return false;
  Matrix D = onto(Matrix::Identity(t.C.rows(), t.C.rows()), t.C);
  D = ((D + D.transpose()) / 2).eval();
  D = (D.array().abs() > round_off_of_a_sum * (t.C.cwiseAbs() + t.C.transpose().cwiseAbs()).array())
          .select(D, 0.0);
  Vector scale(D.rows());
  for (Index i = 0; i < D.rows(); ++i) {
    if (D(i, i) < 0.0 || (D(i, i) == 0.0 && !D.row(i).isZero(0.0))) return false;
    scale[i] = D(i, i) > 0.0 ? 1.0 / std::sqrt(D(i, i)) : 0.0;
  }
  const Vector shares = dense::symmetric_eigen(scale.asDiagonal() * D * scale.asDiagonal()).values;
  return D.rows() == 0 || shares.minCoeff() >= -round_off_of_a_sum;
}

/// A solution z exp(s t) of (1) that is no state at rest.
struct Solution {
  std::complex<double> s;
  double error;  ///< to which s is known
  Eigen::VectorXcd z;
  bool positive;  ///< whether its energy is > 0
};

/// Draws the conclusion from an eigenvalue.
void judge(Verdict& verdict, const Solution& x, bool energy_tells) {
  if (x.s.real() > x.error) {
    verdict.grows_by(x.s);
  } else if (!(x.s.real() < -x.error) && !(energy_tells && x.positive)) {
    std::ostringstream text;
    text << "it cannot be told whether a mode of " << x.s.imag() << " rad/time grows as exp(" << x.s.real()
         << " t), since that is known to " << x.error << ", and its energy is not > 0";
    verdict.leave_undecided(text.str());
  }
}

/// The states at rest, one per column, and the other solutions with Im s >= 0.
struct Solutions {
  Matrix at_rest;
  std::vector<Solution> others;
};

Solutions solutions(Tangent& t) {
  /// Of each term of the matrix and each step of the QR algorithm, in units of round-off of the largest.
  constexpr double backward = 10.0;
  const double Omega = scale_time(t);
  const FirstOrder f = first_order(t);
  Solutions found{states_at_rest(t, f), {}};
  Matrix at_rest = found.at_rest;
  at_rest.conservativeResizeLike(Matrix::Zero(f.matrix.rows(), at_rest.cols()));
  const Deflated deflated(f, at_rest);
  const Matrix A = deflated.rest.transpose() * f.matrix * deflated.rest;
  if (A.size() == 0) return found;
  const auto [values, right] = dense::complex_eigen(A);
  const Eigen::MatrixXcd left = dense::inverse(right);
  for (Index k = 0; k < A.rows(); ++k) {
    const std::complex<double> s = values[k];
    if (s.imag() < 0.0) continue;
    // First-order perturbation: |ds| <= |dA| / |y^H x| for left and right eigenvectors of length 1.
    const double condition = left.row(k).norm() * right.col(k).norm();
    const double error = backward * static_cast<double>(A.rows()) * epsilon * A.norm() *
                         (std::isfinite(condition) ? condition : std::numeric_limits<double>::infinity());
    const Eigen::VectorXcd z = deflated.lift(f.matrix, s, right.col(k)).head(t.K.rows());
    const double kinetic = std::norm(s) * z.squaredNorm();
    const double energy = kinetic + (z.adjoint() * t.K * z)(0, 0).real();
    const double unknown = round_off_of_a_sum * z.cwiseAbs().dot(t.K.cwiseAbs() * z.cwiseAbs());
    found.others.push_back({Omega * s, Omega * error, z, energy > 1e-9 * kinetic + unknown});
  }
  return found;
}

void of_any(Tangent t, Verdict& verdict) {
  const Solutions all = solutions(t);
  for (Index k = 0; k < all.at_rest.cols(); ++k)
    verdict.found.modes.push_back(mode(0.0, all.at_rest.col(k).cast<std::complex<double>>(), t));
  const bool energy_tells = has_energy(t);
  for (const Solution& x : all.others) {
    verdict.found.modes.push_back(mode(x.s, x.z, t));
    judge(verdict, x, energy_tells);
  }
}

/// Whether every eigenvalue of a symmetric K is >= 0, within round-off.
bool is_positive(const Tangent& t) {
  if (t.K.size() == 0) return true;
  return dense::symmetric_eigen(t.K).values.minCoeff() >= -t.zero;
}

/// Those of one part, see `vibrations`.
void append_vibrations(Tangent t, std::vector<Vibration>& found) {
  if (t.K.rows() == 0) return;
  const bool gyroscopic = !onto(Matrix::Identity(t.C.rows(), t.C.rows()), t.C - t.C.transpose()).isZero(0.0);
  if (t.B.rows() == 0 && has_energy(t) && (!gyroscopic || is_positive(t))) return;
  if (t.B.rows() == 0 && t.C.isZero(0.0)) {
    for (const std::complex<double> square : dense::eigenvalues(-t.K)) {
      const std::complex<double> s = std::sqrt(square);  // Re s >= 0
      if (s.imag() > 0.0) found.push_back({s, 0.0});
    }
    return;
  }
  for (const Solution& x : solutions(t).others)
    if (x.s.imag() > x.error) found.push_back({x.s, x.error});
}

/// K of one part: its eigenvalues with right eigenvectors and, as rows, those on the left.
struct Decomposed {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd right, left;
};

Decomposed decomposed(const Tangent& t) {
  if (t.symmetric) {
    const auto [values, shapes] = dense::symmetric_eigen(t.K);
    return {values.cast<std::complex<double>>(), shapes.cast<std::complex<double>>(),
            shapes.transpose().cast<std::complex<double>>()};
  }
  auto [values, right] = dense::complex_eigen(t.K);
  Eigen::MatrixXcd left = dense::inverse(right);
  return {std::move(values), std::move(right), std::move(left)};
}

/// A real eigenvalue of K, in the coordinates of the scene.
struct RealShape {
  double value;
  Vector shape, dual;
};

/// Those of one part; returns the smallest real part of all.
double append_real(const Tangent& t, std::vector<RealShape>& found) {
  double least = std::numeric_limits<double>::infinity();
  if (t.K.rows() == 0) return least;
  const Decomposed K = decomposed(t);
  const auto all = static_cast<Index>(t.all);
  for (Index k = 0; k < K.values.size(); ++k) {
    const double value = std::abs(K.values[k]) <= t.zero ? 0.0 : K.values[k].real();
    least = std::min(least, value);
    if (K.values[k].imag() != 0.0) continue;
    RealShape one{value, Vector::Zero(all), Vector::Zero(all)};
    one.shape(t.coordinates) = t.shapes * K.right.col(k).real();
    one.dual(t.coordinates) = t.metric * K.left.row(k).transpose().real();
    found.push_back(std::move(one));
  }
  return least;
}

}  // namespace

Modes dense_modes(const System& system, const LinearTerms& terms, const Matrix& symmetric) {
  Modes found{{}, Stability::stable, "every mode decays or vibrates with positive energy"};
  Verdict verdict{found};
  for (Tangent& t : tangents(system, terms)) {
    if (t.K.rows() == 0) continue;  // a part without freedom
    rest_along(symmetric, t);
    const bool conservative = t.B.rows() == 0 && t.C.isZero(0.0) && t.symmetric;
    conservative ? of_conservative(t, verdict) : of_any(std::move(t), verdict);
  }
  std::ranges::stable_sort(found.modes, {}, [](const Mode& m) { return std::abs(m.eigenvalue); });
  return found;
}

std::vector<Vibration> vibrations(const System& system, const LinearTerms& terms) {
  std::vector<Vibration> found;
  for (Tangent& t : tangents(system, terms)) append_vibrations(std::move(t), found);
  std::ranges::stable_sort(found, std::greater{}, [](const Vibration& x) { return x.s.real(); });
  return found;
}

TangentStiffness tangent_stiffness(const System& system, const LinearTerms& terms) {
  std::vector<RealShape> real;
  double least = std::numeric_limits<double>::infinity();
  for (const Tangent& t : tangents(system, terms)) least = std::min(least, append_real(t, real));
  std::ranges::stable_sort(real, {}, &RealShape::value);
  const auto n = static_cast<Index>(system.coordinates()), count = static_cast<Index>(real.size());
  TangentStiffness found{Vector(count), Matrix(n, count), Matrix(n, count), least};
  for (Index k = 0; k < count; ++k) {
    const RealShape& one = real[static_cast<std::size_t>(k)];
    found.values[k] = one.value;
    found.shapes.col(k) = one.shape;
    found.duals.col(k) = one.dual;
  }
  return found;
}

}  // namespace dalembert
