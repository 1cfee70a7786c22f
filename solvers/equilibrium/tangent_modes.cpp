#include "dalembert/solvers/equilibrium/tangent_modes.h"

#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/linear/products.h>
#include <dalembert/solvers/equilibrium/first_order.h>
#include <dalembert/solvers/equilibrium/symmetries.h>
#include <dalembert/solvers/equilibrium/tangent.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <utility>

namespace dalembert {

namespace {

using Eigen::Index;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

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
  const std::function<bool(std::size_t)>& stable_otherwise;
  std::size_t part = 0;  ///< that is judged
  double growth = 0.0;

  void grows_by(std::complex<double> s) {
    if (!(s.real() > growth)) return;
    growth = s.real();
    found.stability = Stability::unstable;
    found.reason = grows(s);
  }
  void leave_undecided(const std::string& reason) const {
    if (found.stability != Stability::stable || (stable_otherwise && stable_otherwise(part))) return;
    found.stability = Stability::undecided;
    found.reason = reason;
  }
};

/// K z = omega^2 z. What is within round-off of 0 counts as 0, to be decided by a finite motion.
void of_conservative(const Tangent& t, Verdict& verdict) {
  const auto [square, shapes] = dense::symmetric_eigen(t.K);
  for (Index k = 0; k < square.size(); ++k) {
    std::complex<double> s = std::sqrt(std::complex<double>(-square[k]));
    if (std::abs(square[k]) <= t.zero()) s = 0.0;
    s = {std::abs(s.real()), std::abs(s.imag())};
    verdict.found.modes.push_back(mode(s, shapes.col(k).cast<std::complex<double>>(), t));
    verdict.grows_by(s);
  }
}

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

void of_any(Tangent t, Verdict& verdict) {
  const Solutions all = solutions(t);
  for (Index k = 0; k < all.at_rest.cols(); ++k)
    verdict.found.modes.push_back(mode(0.0, all.at_rest.col(k).cast<std::complex<double>>(), t));
  const bool energy_tells = has_energy(t);
  for (const Solution& x : all.others) {
    verdict.found.modes.push_back(mode(x.s, x.z, t));
    verdict.found.modes.back().decays = x.s.real() < -x.error;
    judge(verdict, x, energy_tells);
  }
}

/// Whether every eigenvalue of a symmetric K is >= 0, within round-off.
bool is_positive(const Tangent& t) {
  if (t.K.size() == 0) return true;
  return dense::symmetric_eigen(t.K).values.minCoeff() >= -t.zero();
}

/// Those of one part, see `vibrations`.
void append_vibrations(Tangent t, std::vector<Vibration>& found) {
  if (t.K.rows() == 0) return;
  const bool gyroscopic =
      !onto(Matrix::Identity(t.C.rows(), t.C.rows()), t.C - t.C.transpose(), t.known()).isZero(0.0);
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

/// Its part along the columns of P.
Tangent restricted(Tangent t, const Matrix& P) {
  t.shapes = t.shapes * P;
  t.metric = t.metric * P;
  t.K = dense::restricted(P, t.K);
  t.K_terms = dense::restricted(dense::sizes(P), t.K_terms);
  return t;
}

/// The part of it along which nonholonomic rows let something move.
Tangent along_velocities(Tangent t) {
  return t.B.isZero(0.0) ? t : restricted(t, orthogonal_complement(t.B.transpose()));
}

/// Orthonormal displacements by symmetries, as z, that all rows admit. K is 0 along them, as exactly as a
/// position is known.
Matrix symmetric_within(const System& system, const Tangent& t, const Matrix& symmetric) {
  const Matrix none(t.K.rows(), 0);
  const double known = std::sqrt(rank_threshold);
  Vector root(t.metric.rows());
  for (Index i = 0; i < root.size(); ++i)
    root[i] = std::sqrt(system.masses()[t.coordinates[static_cast<std::size_t>(i)]]);
  const Matrix own = orthonormal_span(root.asDiagonal() * symmetric(t.coordinates, Eigen::all));
  if (own.cols() == 0) return none;
  const Matrix N = root.cwiseInverse().asDiagonal() * t.metric, z = N.transpose() * own,
               admitted = z * dense::kernel_within(own - N * z, known);
  if (admitted.cols() == 0) return none;
  const double left = (t.K * admitted).cwiseAbs().maxCoeff(),
               terms = (t.K_terms * dense::sizes(admitted)).maxCoeff();
  return left <= known * terms ? admitted : none;
}

/// A real eigenvalue of K, in the coordinates of the scene.
struct RealShape {
  double value;
  Vector shape, dual;
};

/// Those of one part; what belongs to all eigenvalues goes into `sum`.
void append_real(const System& system, const Tangent& whole, const Matrix& symmetric,
                 std::vector<RealShape>& found, TangentStiffness& sum) {
  if (whole.K.rows() == 0) return;
  Tangent t = along_velocities(whole);
  if (const Matrix free = symmetric_within(system, t, symmetric); free.cols() > 0) {
    sum.least = std::min(sum.least, 0.0);
    t = restricted(std::move(t), orthogonal_complement(free));
  }
  const Decomposed K = decomposed(t);
  const auto all = static_cast<Index>(t.all);
  for (Index k = 0; k < K.values.size(); ++k) {
    const double value = std::abs(K.values[k]) <= t.zero() ? 0.0 : K.values[k].real();
    sum.least = std::min(sum.least, value);
    if (value != 0.0) sum.log_determinant += std::log(std::abs(K.values[k]));
    if (K.values[k].imag() != 0.0) continue;
    sum.negative = sum.negative != (value < 0.0);
    RealShape one{value, Vector::Zero(all), Vector::Zero(all)};
    one.shape(t.coordinates) = t.shapes * Vector(K.right.col(k).real());
    one.dual(t.coordinates) = t.metric * Vector(K.left.row(k).transpose().real());
    found.push_back(std::move(one));
  }
}

}  // namespace

Modes dense_modes(const System& system, const LinearTerms& terms, const UniformMotion* motion,
                  const std::function<bool(std::size_t)>& stable_otherwise) {
  Modes found{{}, Stability::stable, "every mode decays or vibrates with positive energy"};
  Verdict verdict{found, stable_otherwise};
  for (Tangent& t : tangents(system, terms, motion)) {
    const bool conservative = t.B.rows() == 0 && t.C.isZero(0.0) && t.symmetric;
    if (t.K.rows() > 0)  // a part with some freedom
      conservative ? of_conservative(t, verdict) : of_any(std::move(t), verdict);
    ++verdict.part;
  }
  std::ranges::stable_sort(found.modes, {}, [](const Mode& m) { return std::abs(m.eigenvalue); });
  return found;
}

std::vector<char> attracting_parts(const System& system, const LinearTerms& terms,
                                   const UniformMotion& motion) {
  std::vector<char> found;
  for (const Tangent& t : tangents(system, terms, &motion)) {
    const Matrix own = motion.carried(t.coordinates, Eigen::all);
    const Index carried = orthonormal_span(t.metric.transpose() * own).cols(),
                states = t.K.rows() + along_velocities(t).K.rows();
    Index decaying = 0;
    if (carried > 0) {
      for (const Solution& x : solutions(t).others)
        if (x.s.real() < -x.error) decaying += x.s.imag() > 0.0 ? 2 : 1;
    }
    found.push_back(carried > 0 && decaying + carried == states ? 1 : 0);
  }
  return found;
}

std::vector<Vibration> vibrations(const System& system, const LinearTerms& terms) {
  std::vector<Vibration> found;
  for (Tangent& t : tangents(system, terms)) append_vibrations(std::move(t), found);
  std::ranges::stable_sort(found, std::greater{}, [](const Vibration& x) { return x.s.real(); });
  return found;
}

std::vector<Vibration> all_vibrations(const System& system, const LinearTerms& terms,
                                      const UniformMotion& motion) {
  std::vector<Vibration> found;
  for (const Tangent& t : tangents(system, terms, &motion)) {
    if (t.K.rows() == 0) continue;
    for (const Solution& x : solutions(t).others) found.push_back({x.s, x.error});
  }
  std::ranges::stable_sort(found, std::greater{}, [](const Vibration& x) { return x.s.real(); });
  return found;
}

TangentStiffness tangent_stiffness(const System& system, const LinearTerms& terms, const Matrix& symmetric) {
  std::vector<RealShape> real;
  TangentStiffness found;
  for (const Tangent& t : tangents(system, terms)) append_real(system, t, symmetric, real, found);
  std::ranges::stable_sort(real, {}, &RealShape::value);
  const auto n = static_cast<Index>(system.coordinates()), count = static_cast<Index>(real.size());
  found.values.resize(count);
  found.shapes.resize(n, count);
  found.duals.resize(n, count);
  for (Index k = 0; k < count; ++k) {
    const RealShape& one = real[static_cast<std::size_t>(k)];
    found.values[k] = one.value;
    found.shapes.col(k) = one.shape;
    found.duals.col(k) = one.dual;
  }
  return found;
}

}  // namespace dalembert
