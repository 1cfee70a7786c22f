#include "dalembert/solvers/equilibrium/quadratic_modes.h"

#include <dalembert/core/errors.h>
#include <dalembert/core/linear/dense.h>
#include <dalembert/solvers/base/accuracy.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/mass_metric.h>
#include <dalembert/solvers/linear/complex_lu.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <sstream>
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
  // Insensitive: ten times more or less gives the same modes, which inverse iteration improves.
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
    const bool exhausted = rest <= converged_to * H.norm();
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

/// The equations as they stand, of x = (u, y), in complex numbers.
class Equations {
 public:
  using Matrix = ComplexLU::Matrix;

  Equations(const System& system, const LinearTerms& terms, QuadraticInverse& S)
      : S_(&S),
        n_(S.root().size()),
        K_(n_ + static_cast<Index>(S.rows().size()), n_ + static_cast<Index>(S.rows().size())),
        C_(K_.rows(), K_.rows()),
        M_(Eigen::VectorXcd::Zero(K_.rows())),
        lengths_(static_cast<Index>(S.rows().size())),
        compliance_(lengths_.size()),
        c_(norm_in_mass_metric(terms.damping, S.root())),
        k_(norm_in_mass_metric(terms.stiffness, S.root())) {
    M_.head(n_) = S.root().cwiseAbs2().cast<Complex>();
    C_.setFromTriplets(terms.damping.begin(), terms.damping.end());
    std::vector<Eigen::Triplet<Complex>> entries;
    for (const auto& k : terms.stiffness)
      entries.emplace_back(static_cast<int>(k.row()), static_cast<int>(k.col()), k.value());
    for (Index a = 0; a < lengths_.size(); ++a) {
      const std::size_t r = S.rows().rows[static_cast<std::size_t>(a)];
      const int own = static_cast<int>(n_ + a);
      double square = 0.0;
      for (const std::size_t k : system.row(r)) {
        const auto j = static_cast<int>(system.w_columns()[k]);
        entries.emplace_back(j, own, -terms.w[k]);
        entries.emplace_back(own, j, terms.w[k]);
        square += std::pow(terms.w[k] / S.root()[j], 2);
      }
      compliance_[a] = system.law(r).compliance;
      entries.emplace_back(own, own, compliance_[a]);
      lengths_[a] = std::sqrt(square);
    }
    K_.setFromTriplets(entries.begin(), entries.end());
  }

  /// x = (M^1/2 u, M^1/2 s u/Omega); S once more, S x = theta x, gives u and its multipliers y/theta.
  [[nodiscard]] QuadraticPair pair(const Eigen::VectorXcd& x, Complex theta, Complex s) const {
    const Vector re = (*S_)(x.real()), y_re = S_->multipliers(), im = (*S_)(x.imag()),
                 y_im = S_->multipliers();
    const Complex i(0.0, 1.0);
    Eigen::VectorXcd z(K_.rows());
    z << (re.head(n_) + i * im.head(n_)).cwiseQuotient(S_->root()), y_re + i * y_im;
    z /= theta;
    constexpr double bound = roundings_of_a_sum * epsilon;
    double backward = backward_error(s, z);
    const double known = std::abs(s);
    for (int step = 0; step < 3 && !(backward <= bound) && known > 0.0; ++step) {
      improve(s, z);
      backward = backward_error(s, z);
    }
    return {s, z.head(n_), backward, s.real() > 0.0 && s.imag() >= 0.0 ? error(s, z) : 0.0};
  }

 private:
  [[nodiscard]] Matrix at(Complex s) const {
    Matrix Q = K_ + s * C_;
    Q += Matrix((s * s * M_).asDiagonal());
    return Q;
  }
  [[nodiscard]] Eigen::VectorXcd slope(Complex s, const Eigen::VectorXcd& z) const {
    return 2.0 * s * M_.cwiseProduct(z) + C_ * z;
  }
  /// |u| and |f| in the mass metric.
  [[nodiscard]] double size_of(const Eigen::VectorXcd& z) const {
    return z.head(n_).cwiseProduct(S_->root()).norm();
  }
  [[nodiscard]] double size_of_force(const Eigen::VectorXcd& z) const {
    return z.head(n_).cwiseQuotient(S_->root()).norm();
  }
  /// |W^T y|, of the multipliers alone.
  [[nodiscard]] double reaction(Eigen::VectorXcd z) const {
    z.head(n_).setZero();
    return size_of_force(K_ * z);
  }
  [[nodiscard]] double size_of_terms(Complex s, const Eigen::VectorXcd& z) const {
    return (std::norm(s) + std::abs(s) * c_ + k_) * size_of(z) + reaction(z);
  }
  [[nodiscard]] double backward_error(Complex s, const Eigen::VectorXcd& z) const {
    const Eigen::VectorXcd f = at(s) * z;
    double worst = size_of_force(f) / size_of_terms(s, z);
    for (Index a = 0; a < lengths_.size(); ++a) {
      const double size = lengths_[a] * size_of(z) + compliance_[a] * std::abs(z[n_ + a]);
      worst = std::max(worst, std::abs(f[n_ + a]) / size);
    }
    return worst;
  }
  /// Newton's method on Q(s) z = 0 and z of its length: inverse iteration. False where Q is exactly singular.
  void improve(Complex& s, Eigen::VectorXcd& z) const {
    const ComplexLU lu(at(s));
    if (!lu.regular()) return;
    const Eigen::VectorXcd next = lu.solve(slope(s, z));
    const Eigen::VectorXcd own = M_.cwiseProduct(z);
    s -= own.dot(z) / own.dot(next);
    z = next / size_of(next);
  }
  [[nodiscard]] double error(Complex s, const Eigen::VectorXcd& z) const {
    // So that Q is regular. Inverse iteration does not depend on it: a hundred times more or less is the
    // same.
    constexpr double beside = 1e-10;
    const ComplexLU lu(at(s * (1.0 + beside)));
    if (!lu.regular()) return std::numeric_limits<double>::infinity();
    Eigen::VectorXcd v = M_.cwiseProduct(z);
    for (int twice = 0; twice < 2; ++twice) {
      v = lu.solve_adjoint(v);
      v /= size_of(v);
      if (twice == 0) v = M_.cwiseProduct(v).eval();
    }
    const double terms = size_of_terms(s, z) + reaction(v) * size_of(z);
    return roundings_of_a_sum * epsilon * terms / std::abs(v.dot(slope(s, z)));
  }

  QuadraticInverse* S_;
  Index n_;
  Matrix K_, C_;
  Eigen::VectorXcd M_;
  Vector lengths_, compliance_;
  double c_, k_;
};

/// The |s| of the `wanted`th that counts, and what is equal to it.
double largest_wanted(const Eigen::VectorXcd& theta, double sigma, double zero, std::size_t wanted) {
  std::vector<double> sizes;
  for (const Complex t : theta) {
    const Complex s = sigma + 1.0 / t;
    if (std::abs(s) > zero && s.imag() >= 0.0) sizes.push_back(std::abs(s));
  }
  std::ranges::sort(sizes);
  return sizes.size() < wanted ? std::numeric_limits<double>::infinity() : 1.000001 * sizes[wanted - 1];
}

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
  const double largest = largest_wanted(values, sigma, zero, wanted);
  const Equations equations(system, terms, S);
  std::vector<QuadraticPair> found;
  for (Index k = 0; k < values.size(); ++k) {
    const Complex s = sigma + 1.0 / values[k];
    if (std::abs(s) > largest) continue;
    Eigen::VectorXcd x = Eigen::VectorXcd::Zero(S.size());
    for (Index i = 0; i < vectors.rows(); ++i)
      x += vectors(i, k) * search.basis()[static_cast<std::size_t>(i)];
    if (std::abs(s) <= zero) {
      found.push_back({s, x.head(S.root().size()).cwiseQuotient(S.root()), 0.0});
      continue;
    }
    const QuadraticPair pair = equations.pair(x, values[k], s);
    if (!(pair.backward_error <= roundings_of_a_sum * epsilon)) {
      std::ostringstream why;
      why << "a mode of eigenvalue " << s << " satisfies its equations only to " << pair.backward_error
          << " of their terms; leave out what is stiff and does not act on it";
      refuse_quadratic(system, why.str());
    }
    found.push_back(pair);
  }
  std::ranges::stable_sort(found, {}, [](const QuadraticPair& p) { return std::abs(p.s); });
  return found;
}

}  // namespace dalembert
