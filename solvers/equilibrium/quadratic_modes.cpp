#include "dalembert/solvers/equilibrium/quadratic_modes.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/mass_metric.h>
#include <dalembert/solvers/linear/dense.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <string>

namespace dalembert {

namespace {

using Eigen::Index;
using Vector = Eigen::VectorXd;
using Complex = std::complex<double>;

[[noreturn]] void refuse_quadratic(const System& system, const std::string& why) {
  throw InvalidScene("Normal modes of scene \"" + system.layout()->scene + "\": " + why);
}

LinearTerms at_shift(const LinearTerms& terms, double sigma) {
  LinearTerms shifted = terms;
  for (const auto& d : terms.damping) shifted.stiffness.emplace_back(d.row(), d.col(), sigma * d.value());
  return shifted;
}

/// S of the header, on (M^1/2 a, M^1/2 b/Omega).
class QuadraticInverse {
 public:
  QuadraticInverse(const System& system, const LinearTerms& terms, double sigma, double Omega)
      : sigma_(sigma),
        Omega_(Omega),
        root_(Eigen::Map<const Vector>(system.masses().data(), static_cast<Index>(system.coordinates()))
                  .cwiseSqrt()),
        C_(root_.size(), root_.size()),
        rows_(independent_rows(system, terms.w)),
        matrix_(system, rows_, at_shift(terms, sigma), sigma * sigma),
        y_(system.coordinates() + rows_.size()) {
    if (!matrix_.regular()) refuse_quadratic(system, "the equations of small motions are singular");
    C_.setFromTriplets(terms.damping.begin(), terms.damping.end());
  }

  [[nodiscard]] Vector operator()(const Vector& x) {
    const Index n = root_.size();
    const Vector a = x.head(n).cwiseQuotient(root_), b = Omega_ * x.tail(n).cwiseQuotient(root_);
    std::ranges::fill(y_, 0.0);
    Eigen::Map<Vector> p(y_.data(), n);
    p = -(root_.cwiseAbs2().cwiseProduct(b + sigma_ * a) + C_ * a);
    matrix_.solve(y_);
    Vector out(2 * n);
    out << root_.cwiseProduct(p), root_.cwiseProduct(a + sigma_ * p) / Omega_;
    return out;
  }
  /// Of the last call, one per active row.
  [[nodiscard]] Vector multipliers() const {
    const Index n = root_.size();
    return Eigen::Map<const Vector>(y_.data() + n, static_cast<Index>(rows_.size()));
  }
  [[nodiscard]] Index size() const { return 2 * root_.size(); }
  [[nodiscard]] const Vector& root() const { return root_; }
  [[nodiscard]] const ActiveRows& rows() const { return rows_; }
  [[nodiscard]] const Eigen::SparseMatrix<double, 0, Index>& damping() const { return C_; }

 private:
  double sigma_, Omega_;
  Vector root_;
  Eigen::SparseMatrix<double, 0, Index> C_;
  ActiveRows rows_;
  TangentMatrix matrix_;
  std::vector<double> y_;
};

/// What is known of the spectrum of S: an orthonormal basis of an invariant subspace, S on it, and whether
/// more is needed.
class Search {
 public:
  Search(QuadraticInverse& S, double sigma, double zero, std::size_t wanted)
      : S_(&S), sigma_(sigma), zero_(zero), wanted_(wanted) {}

  enum class Outcome { found, nothing_nearer, nothing_left, not_converged };
  [[nodiscard]] Outcome run(unsigned seed);
  [[nodiscard]] const std::vector<Vector>& basis() const { return basis_; }
  [[nodiscard]] dense::ComplexEigen eigen() const { return dense::complex_eigen(T_); }

 private:
  /// The |s - sigma| up to which everything has to be known, by those known so far and some more.
  [[nodiscard]] double reach(std::span<const Complex> more) const;
  [[nodiscard]] double distance(Complex theta) const { return 1.0 / std::abs(theta); }
  void lock(std::span<const Vector> krylov, const Eigen::MatrixXcd& schur);
  void deflate(Vector& x) const {
    for (const Vector& b : basis_) x -= b.dot(x) * b;
  }

  QuadraticInverse* S_;
  double sigma_, zero_;
  std::size_t wanted_;
  std::vector<Vector> basis_;
  Eigen::MatrixXd T_{0, 0};
  std::vector<Complex> known_;  // eigenvalues theta
};

double Search::reach(std::span<const Complex> more) const {
  std::vector<double> sizes;
  for (const std::span<const Complex> some : {std::span<const Complex>(known_), more}) {
    for (const Complex theta : some) {
      const Complex s = sigma_ + 1.0 / theta;
      const bool conjugate = s.imag() < -1e-10 * std::abs(s);  // by rounding a real one may be counted or not
      if (!conjugate && std::abs(s) > zero_) sizes.push_back(std::abs(s));
    }
  }
  std::ranges::sort(sizes);
  return sizes.size() < wanted_ ? std::numeric_limits<double>::infinity() : sizes[wanted_ - 1] + sigma_;
}

/// The real span of some Schur vectors, closed under conjugation.
void Search::lock(std::span<const Vector> krylov, const Eigen::MatrixXcd& schur) {
  const Index k = schur.cols();
  Eigen::MatrixXd both(schur.rows(), 2 * k);
  both << schur.real(), schur.imag();
  const Eigen::MatrixXd Y = dense::orthonormal(both, k);
  const Index before = T_.rows();
  for (Index j = 0; j < k; ++j) {
    Vector x = Vector::Zero(S_->size());
    for (Index i = 0; i < Y.rows(); ++i) x += Y(i, j) * krylov[static_cast<std::size_t>(i)];
    basis_.push_back(x);
  }
  T_.conservativeResizeLike(Eigen::MatrixXd::Zero(before + k, before + k));
  for (Index j = before; j < before + k; ++j) {
    const Vector x = (*S_)(basis_[static_cast<std::size_t>(j)]);
    for (Index i = 0; i < before + k; ++i) T_(i, j) = basis_[static_cast<std::size_t>(i)].dot(x);
  }
  const Eigen::VectorXcd values = dense::eigenvalues(T_);
  known_.assign(values.begin(), values.end());
}

/// How many leading Schur values have converged, conjugates together.
Index converged(const dense::Schur& schur, double rest) {
  constexpr double well_known = 1e-13;
  const Index m = schur.T.rows();
  Index k = 0;
  double square = 0.0;
  while (k < m) {
    square += std::norm(schur.U(m - 1, k));
    if (!(rest * std::sqrt(square) <= well_known * std::abs(schur.T(0, 0)))) break;
    ++k;
  }
  const auto paired = [&] {
    int balance = 0;
    for (Index j = 0; j < k; ++j) {
      const Complex t = schur.T(j, j);
      if (std::abs(t.imag()) > 1e-10 * std::abs(t)) balance += t.imag() > 0.0 ? 1 : -1;
    }
    return balance == 0;
  };
  while (k > 0 && !paired()) --k;
  return k;
}

Search::Outcome Search::run(unsigned seed) {
  constexpr std::size_t most_vectors = 400;
  std::vector<Vector> krylov;
  Vector x = (*S_)((*S_)(generic_vector(S_->size(), seed)));  // into the tangent space
  const double whole = x.norm();
  for (int twice = 0; twice < 2; ++twice) deflate(x);
  if (!(x.norm() > 1e-10 * whole)) return Outcome::nothing_left;
  double rest = x.norm();
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(0, 0);
  for (std::size_t look = 10; krylov.size() < most_vectors;) {
    krylov.push_back(x / rest);
    x = (*S_)(krylov.back());
    const auto m = static_cast<Index>(krylov.size());
    H.conservativeResizeLike(Eigen::MatrixXd::Zero(m, m));
    if (m > 1) H(m - 1, m - 2) = rest;
    for (int twice = 0; twice < 2; ++twice) {
      deflate(x);
      for (Index i = 0; i < m; ++i) {
        const Vector& b = krylov[static_cast<std::size_t>(i)];
        const double h = b.dot(x);
        H(i, m - 1) += h;
        x -= h * b;
      }
    }
    rest = x.norm();
    const bool exhausted = rest <= 1e-14 * H.norm();
    if (!exhausted && krylov.size() < std::min(look, most_vectors)) continue;
    look += look / 4;
    const dense::Schur schur = dense::ordered_schur(H);
    const Index k = converged(schur, exhausted ? 0.0 : rest);
    if (k == 0) continue;
    const Eigen::VectorXcd values = schur.T.diagonal().head(k);
    const bool far_enough = distance(values[k - 1]) >= reach(std::span(values.data(), values.data() + k));
    if (!exhausted && !far_enough) continue;
    if (distance(values[0]) >= reach({})) return Outcome::nothing_nearer;
    lock(krylov, schur.U.leftCols(k));
    return Outcome::found;
  }
  return Outcome::not_converged;
}

/// Largest row sum of absolute values: no less than the norm of a symmetric or a skew matrix.
double norm_in_mass_metric(const LinearTerms::Entries& entries, const Vector& root) {
  Vector sums = Vector::Zero(root.size());
  for (const auto& e : entries) {
    const auto i = static_cast<Index>(e.row()), j = static_cast<Index>(e.col());
    sums[i] += std::abs(e.value()) / (root[i] * root[j]);
  }
  return sums.size() > 0 ? sums.maxCoeff() : 0.0;
}

/// The residuals of solutions in the equations as they stand, not in S.
class Residual {
 public:
  Residual(const System& system, const LinearTerms& terms, QuadraticInverse& S)
      : system_(&system),
        terms_(&terms),
        S_(&S),
        K_(S.root().size(), S.root().size()),
        c_(norm_in_mass_metric(terms.damping, S.root())),
        k_(norm_in_mass_metric(terms.stiffness, S.root())) {
    K_.setFromTriplets(terms.stiffness.begin(), terms.stiffness.end());
  }

  /// x = (M^1/2 u, M^1/2 s u/Omega); S once more, S x = theta x, gives u and its multipliers y/theta.
  [[nodiscard]] QuadraticPair pair(const Eigen::VectorXcd& x, Complex theta, Complex s) const {
    const Index n = S_->root().size();
    const Vector re = (*S_)(x.real()), y_re = S_->multipliers(), im = (*S_)(x.imag()),
                 y_im = S_->multipliers();
    const Complex i(0.0, 1.0);
    const Eigen::VectorXcd xi = (re.head(n) + i * im.head(n)) / theta, y = (y_re + i * y_im) / theta;
    const Eigen::VectorXcd u = xi.cwiseQuotient(S_->root());
    Eigen::VectorXcd f = s * s * S_->root().cwiseAbs2().cwiseProduct(u) + s * (S_->damping() * u) + K_ * u;
    Eigen::VectorXcd force = Eigen::VectorXcd::Zero(n);
    double apart = 0.0;
    for (std::size_t a = 0; a < S_->rows().size(); ++a) {
      const std::size_t r = S_->rows().rows[a];
      const Complex multiplier = y[static_cast<Index>(a)];
      const double c = system_->law(r).compliance;
      Complex g = c * multiplier;
      double length = 0.0;
      for (const std::size_t k : system_->row(r)) {
        const auto j = static_cast<Index>(system_->w_columns()[k]);
        g += terms_->w[k] * u[j];
        force[j] += terms_->w[k] * multiplier;
        length += std::pow(terms_->w[k] / S_->root()[j], 2);
      }
      apart = std::max(apart, std::abs(g) / (std::sqrt(length) * xi.norm() + c * std::abs(multiplier)));
    }
    f -= force;
    const double size =
        (std::norm(s) + std::abs(s) * c_ + k_) * xi.norm() + force.cwiseQuotient(S_->root()).norm();
    return {s, u, std::max(apart, f.cwiseQuotient(S_->root()).norm() / size)};
  }

 private:
  const System* system_;
  const LinearTerms* terms_;
  QuadraticInverse* S_;
  Eigen::SparseMatrix<double, 0, Index> K_;
  double c_, k_;
};

}  // namespace

Vector generic_vector(Index n, unsigned seed) {
  std::mt19937 generator(seed);  // the engine's numbers are the standard's, its distributions' are not
  Vector x(n);
  for (Index i = 0; i < n; ++i) x[i] = static_cast<double>(generator()) / 4294967296.0 - 0.5;
  return x;
}

std::vector<QuadraticPair> nearest_solutions(const System& system, const LinearTerms& terms, double sigma,
                                             double unit_of_frequency, double zero, std::size_t wanted) {
  QuadraticInverse S(system, terms, sigma, unit_of_frequency);
  Search search(S, sigma, zero, wanted);
  using Outcome = Search::Outcome;
  Outcome outcome = Outcome::found;
  for (unsigned run = 1; outcome == Outcome::found; ++run) outcome = search.run(run);
  if (outcome == Outcome::not_converged)
    refuse_quadratic(system, "of " + std::to_string(wanted) + " modes not all converged; ask for fewer");
  const auto [values, vectors] = search.eigen();
  const Residual residual(system, terms, S);
  std::vector<QuadraticPair> found;
  for (Index k = 0; k < values.size(); ++k) {
    Eigen::VectorXcd x = Eigen::VectorXcd::Zero(S.size());
    for (Index i = 0; i < vectors.rows(); ++i)
      x += vectors(i, k) * search.basis()[static_cast<std::size_t>(i)];
    const QuadraticPair pair = residual.pair(x, values[k], sigma + 1.0 / values[k]);
    if (std::abs(pair.s) > zero && !(pair.backward_error <= roundings_of_a_sum * epsilon))
      refuse_quadratic(system, "a mode satisfies its equations only to " +
                                   std::to_string(pair.backward_error) +
                                   " of their terms; leave out what is stiff and does not act on it");
    found.push_back(pair);
  }
  std::ranges::stable_sort(found, {}, [](const QuadraticPair& p) { return std::abs(p.s); });
  return found;
}

}  // namespace dalembert
