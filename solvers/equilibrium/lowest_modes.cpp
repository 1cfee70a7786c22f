#include "dalembert/solvers/equilibrium/lowest_modes.h"

#include <dalembert/core/linear/products.h>
#include <dalembert/solvers/base/accuracy.h>
#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/mass_metric.h>
#include <dalembert/solvers/equilibrium/quadratic_modes.h>
#include <dalembert/solvers/linear/rows.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <sstream>

namespace dalembert {

namespace {

using Eigen::Index;
using Vector = Eigen::VectorXd;

struct Pair {
  double square;  // omega^2
  Vector x;       // M^1/2 u, of unit length
};

Vector root_of_masses(const System& system) {
  return Eigen::Map<const Vector>(system.masses().data(), static_cast<Index>(system.coordinates()))
      .cwiseSqrt();
}

/// The operator T on x = M^1/2 u, where it is symmetric in the usual sense.
class Inverse {
 public:
  Inverse(const System& system, const LinearTerms& terms, double s)
      : shift(s),
        root_(root_of_masses(system)),
        rows_(independent_rows(system, terms.w)),
        matrix_(system, rows_, terms, s),
        y_(system.coordinates() + rows_.size()) {
    if (!matrix_.regular())
      throw InvalidScene("The equations of small motions are singular: no modes can be found");
  }

  [[nodiscard]] Vector operator()(const Vector& x) {
    std::ranges::fill(y_, 0.0);
    const Index n = root_.size();
    Eigen::Map<Vector>(y_.data(), n) = root_.cwiseProduct(x);
    matrix_.solve(y_);
    return root_.cwiseProduct(Eigen::Map<const Vector>(y_.data(), n));
  }
  [[nodiscard]] Index size() const { return root_.size(); }

  const double shift;

 private:
  Vector root_;
  ActiveRows rows_;
  TangentMatrix matrix_;
  std::vector<double> y_;
};

void orthogonalise(Vector& x, std::span<const Vector> basis, std::span<const Pair> found) {
  for (int twice = 0; twice < 2; ++twice) {  // twice is enough (Parlett, 6.9)
    for (const Pair& pair : found) x -= pair.x.dot(x) * pair.x;
    for (const Vector& b : basis) x -= b.dot(x) * b;
  }
}

/// The matrix that T has on the vectors so far, tridiagonal, and how well its eigenvalues are known.
struct Ritz {
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  std::vector<Index> best;  // the largest eigenvalues, in absolute value
  std::vector<Index> converged;

  void compute(std::span<const double> diagonal, std::span<const double> below, std::size_t wanted) {
    constexpr double well_known = 1e-13;
    const auto m = static_cast<Index>(diagonal.size());
    const Eigen::Map<const Vector> a(diagonal.data(), m), b(below.data(), m - 1);
    solver.computeFromTridiagonal(a, b);
    best.clear();
    converged.clear();
    for (Index k = 0; k < m; ++k) best.push_back(k);
    const auto size = [this](Index k) { return std::abs(solver.eigenvalues()[k]); };
    std::ranges::sort(best, std::greater{}, size);
    best.resize(std::min(best.size(), wanted));
    for (const Index k : best) {
      const double residual = below.back() * std::abs(solver.eigenvectors()(m - 1, k));
      if (residual <= well_known * size(best.front())) converged.push_back(k);
    }
  }
};

/// One run of Lanczos' method: the wanted number of the lowest not found yet, fewer if there are no more.
std::vector<Pair> lanczos(Inverse& T, std::span<const Pair> found, std::size_t wanted, unsigned seed) {
  constexpr std::size_t most_vectors = 400, between_looks = 5;
  std::vector<Vector> basis;
  std::vector<double> diagonal, below;
  Vector x = T(generic_vector(T.size(), seed));  // into the tangent space
  const double whole = x.norm();
  orthogonalise(x, basis, found);
  if (!(x.norm() > 1e-10 * whole)) return {};
  below.push_back(x.norm());
  Ritz ritz;
  bool exhausted = false;
  while (!exhausted && ritz.converged.size() < wanted && basis.size() < most_vectors) {
    basis.push_back(x / below.back());
    x = T(basis.back());
    diagonal.push_back(basis.back().dot(x));
    orthogonalise(x, basis, found);
    below.push_back(x.norm());
    exhausted = below.back() <= converged_to * std::abs(diagonal.front());
    if (exhausted || basis.size() % between_looks == 0)
      ritz.compute(diagonal, std::span(below).subspan(1), wanted);
  }
  std::vector<Pair> pairs;
  for (const Index k : ritz.converged) {
    Pair pair{1.0 / ritz.solver.eigenvalues()[k] - T.shift, Vector::Zero(T.size())};
    for (std::size_t i = 0; i < diagonal.size() && static_cast<Index>(i) < ritz.solver.eigenvalues().size();
         ++i)
      pair.x += ritz.solver.eigenvectors()(static_cast<Index>(i), k) * basis[i];
    pair.x.normalize();
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

/// The lowest, by runs until one finds nothing lower.
std::vector<Pair> lowest_pairs(Inverse& T, std::size_t wanted) {
  std::vector<Pair> found;
  const auto closeness = [&T](const Pair& p) { return std::abs(p.square + T.shift); };
  for (unsigned run = 1;; ++run) {
    std::vector<Pair> more = lanczos(T, found, wanted, run);
    const double farthest = found.size() < wanted ? INFINITY : closeness(found[wanted - 1]);
    const bool belongs = std::ranges::any_of(more, [&](const Pair& p) { return closeness(p) < farthest; });
    if (!belongs) return found;
    for (Pair& pair : more) found.push_back(std::move(pair));
    std::ranges::sort(found, {}, closeness);
  }
}

/// The largest K/M of a pair of coordinates.
double stiffest(const System& system, const LinearTerms& terms) {
  double largest = 0.0;
  for (const auto& entry : terms.stiffness) {
    const double m = std::sqrt(system.masses()[entry.row()] * system.masses()[entry.col()]);
    largest = std::max(largest, std::abs(entry.value()) / m);
  }
  for (std::size_t r = 0; r < system.rows(); ++r) {
    const double C = system.law(r).compliance;
    if (C == 0.0) continue;  // a spring: w w^T/C
    largest = std::max(largest, inverse_effective_mass(system, terms.w, r) / C);
  }
  return largest;
}

/// Whether no omega^2 is below -s (Finsler's lemma): if and only if K + s M + rho W^T W is positive definite
/// for rho large enough. Round-off of rho must stay below s, and so must 1/rho times K^2.
bool nothing_below(const System& system, const LinearTerms& terms, double s, double largest) {
  const double rho = largest * largest / (0.1 * s);
  LinearTerms::Entries entries;
  const auto root = [&](std::size_t i) { return std::sqrt(system.masses()[i]); };
  for (const auto& k : terms.stiffness) {
    const double scale = root(k.row()) * root(k.col());
    entries.emplace_back(k.row(), k.col(), k.value() / scale);
  }
  for (std::size_t i = 0; i < system.coordinates(); ++i)
    entries.emplace_back(static_cast<int>(i), static_cast<int>(i), s);
  for (std::size_t r = 0; r < system.rows(); ++r) {
    double square = 0.0;
    for (const std::size_t k : system.row(r)) square += std::pow(terms.w[k] / root(system.w_columns()[k]), 2);
    const double C = system.law(r).compliance, weight = C > 0.0 ? 1.0 / C : rho / square;
    for (const std::size_t k : system.row(r)) {
      for (const std::size_t l : system.row(r)) {
        const std::size_t i = system.w_columns()[k], j = system.w_columns()[l];
        entries.emplace_back(static_cast<int>(i), static_cast<int>(j),
                             weight * terms.w[k] * terms.w[l] / (root(i) * root(j)));
      }
    }
  }
  const auto n = static_cast<Index>(system.coordinates());
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldl(A);
  return ldl.info() == Eigen::Success && ldl.vectorD().minCoeff() > 0.0;
}

void require_suitable(const System& system, std::size_t wanted) {
  const char* why = nullptr;
  if (wanted == 0) why = "all modes are too many; set the option lowest";
  if (system.holonomic_rows() < system.rows())
    why = "so many are analysed only without nonholonomic constraints";
  if (why == nullptr) return;
  throw InvalidScene("Normal modes of scene \"" + system.layout()->scene + "\" with " +
                     std::to_string(system.coordinates()) + " coordinates: " + why);
}

/// Lanczos' method may end with fewer than are wanted only where there are no more.
void require_all(const System& system, const LinearTerms& terms, std::size_t found, std::size_t wanted) {
  const ActiveRows rows = independent_rows(system, terms.w);
  const auto rigid = static_cast<std::size_t>(
      std::ranges::count_if(rows.rows, [&](std::size_t r) { return !system.law(r).compliant(); }));
  const std::size_t there = system.coordinates() - rigid;
  if (found >= std::min(wanted, there)) return;
  throw InvalidScene("Normal modes of scene \"" + system.layout()->scene + "\": of " +
                     std::to_string(std::min(wanted, there)) + " modes only " + std::to_string(found) +
                     " converged; ask for fewer");
}

/// The lowest eigenvalues of K, of which there is a symmetric one.
std::vector<Pair> lowest_of_stiffness(const System& system, const LinearTerms& terms, double s,
                                      std::size_t wanted) {
  Inverse T(system, terms, s);
  auto pairs = lowest_pairs(T, wanted);
  require_all(system, terms, pairs.size(), wanted);
  pairs.resize(std::min(pairs.size(), wanted));
  std::ranges::sort(pairs, {}, [](const Pair& p) { return p.square; });
  return pairs;
}

/// Its largest number 1.
Mode scaled_mode(std::complex<double> eigenvalue, Eigen::VectorXcd u) {
  Index most = 0;
  (void)u.cwiseAbs().maxCoeff(&most);
  u /= std::complex<double>(u[most]);
  return {eigenvalue, {u.begin(), u.end()}, false};
}

Modes conservative_modes(const System& system, const LinearTerms& terms, double s, double largest,
                         std::size_t wanted) {
  Modes found{{}, Stability::stable, "every vibration has positive energy"};
  if (!nothing_below(system, terms, s, largest)) {
    found.stability = Stability::undecided;
    found.reason = "it could not be proved that no mode grows fast";
  }
  const double zero = roundings_of_a_sum * epsilon * largest;
  for (const Pair& pair : lowest_of_stiffness(system, terms, s, wanted)) {
    const Vector u = pair.x.cwiseQuotient(root_of_masses(system));
    std::complex<double> eigenvalue = std::sqrt(std::complex<double>(-pair.square));
    if (std::abs(pair.square) <= zero) eigenvalue = 0.0;
    eigenvalue = {std::abs(eigenvalue.real()), std::abs(eigenvalue.imag())};
    if (eigenvalue.real() > 0.0) {
      found.stability = Stability::unstable;
      found.reason = "a mode grows as exp(" + std::to_string(eigenvalue.real()) + " t)";
    }
    found.modes.push_back(scaled_mode(eigenvalue, u.cast<std::complex<double>>()));
  }
  return found;
}

/// Whether damping adds no energy: the symmetric part of C is positive semi-definite, each coordinate scaled
/// by its own so that a strong damper hides no weak negative one.
bool is_dissipative(const System& system, const LinearTerms& terms) {
  const auto n = static_cast<Index>(system.coordinates());
  LinearTerms::Entries entries, sizes;
  for (const auto& d : terms.damping) {
    for (const auto& [i, j] : {std::pair(d.row(), d.col()), std::pair(d.col(), d.row())}) {
      entries.emplace_back(i, j, d.value() / 2.0);
      sizes.emplace_back(i, j, std::abs(d.value()) / 2.0);
    }
  }
  Eigen::SparseMatrix<double> D(n, n), size(n, n);
  D.setFromTriplets(entries.begin(), entries.end());
  size.setFromTriplets(sizes.begin(), sizes.end());
  constexpr double rounding = roundings_of_a_sum * epsilon;
  D.prune([&](Index i, Index j, double value) { return std::abs(value) > rounding * size.coeff(i, j); });
  const Vector own = D.diagonal();
  Vector scale = Vector::Zero(n);
  for (Index i = 0; i < n; ++i) {
    if (own[i] < 0.0 || (own[i] == 0.0 && D.col(i).nonZeros() > 0)) return false;
    scale[i] = own[i] > 0.0 ? 1.0 / std::sqrt(own[i]) : 0.0;
  }
  D = (scale.asDiagonal() * D * scale.asDiagonal()).eval();
  Eigen::SparseMatrix<double> I(n, n);
  I.setIdentity();
  D += rounding * I;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldl(D);
  return ldl.info() == Eigen::Success && ldl.vectorD().minCoeff() > 0.0;
}

/// Eigenvalues s with |s| <= `zero` that free motions have: one each, and one more where it goes on for ever,
/// undamped: -s of those of U^T C U, with U^T M U = 1.
std::size_t zeros_of(const System& system, const LinearTerms& terms, std::span<const Pair> free,
                     double zero) {
  const auto n = static_cast<Index>(system.coordinates()), count = static_cast<Index>(free.size());
  Eigen::SparseMatrix<double> C(n, n);
  C.setFromTriplets(terms.damping.begin(), terms.damping.end());
  Eigen::MatrixXd U(n, count);
  for (Index k = 0; k < count; ++k)
    U.col(k) = free[static_cast<std::size_t>(k)].x.cwiseQuotient(root_of_masses(system));
  const Eigen::MatrixXd Z = U.transpose() * Eigen::MatrixXd(C * U);
  if (count == 0) return 0;
  const Eigen::VectorXcd slow = dense::eigenvalues(Z);
  return free.size() + static_cast<std::size_t>(std::ranges::count_if(
                           slow, [&](std::complex<double> z) { return std::abs(z) <= zero; }));
}

/// With an energy that no damping increases and that is positive, all modes decay or vibrate (Kelvin, Tait;
/// Chetaev), known or not. Otherwise only those that are known can be judged.
void judge_many(Modes& found, const std::optional<QuadraticPair>& fastest, const char* why_not) {
  if (why_not == nullptr) return;
  std::ostringstream text;
  found.stability = Stability::undecided;
  if (!fastest) {
    text << "of the " << found.modes.size() << " modes that were asked for none grows; others may, since "
         << why_not;
  } else if (fastest->s.real() > fastest->error) {
    found.stability = Stability::unstable;
    text << "a mode of " << fastest->s.imag() << " rad/time grows as exp(" << fastest->s.real() << " t)";
  } else {
    text << "it cannot be told whether a mode of " << fastest->s.imag() << " rad/time grows as exp("
         << fastest->s.real() << " t), since that is known to " << fastest->error;
  }
  found.reason = text.str();
}

Modes damped_modes(const System& system, const LinearTerms& terms, double s, double largest,
                   std::size_t wanted) {
  const bool potential = circulatory(terms, system.coordinates()).nonZeros() == 0;
  std::vector<Pair> lowest;
  if (potential) lowest = lowest_of_stiffness(system, terms, s, wanted);
  const double zero_square = roundings_of_a_sum * epsilon * largest, zero = std::sqrt(zero_square);
  const bool positive = std::ranges::all_of(lowest, [&](const Pair& p) { return p.square >= -zero_square; });
  std::vector<Pair> free;
  double unit = std::sqrt(s);
  for (const Pair& pair : lowest) {
    if (std::abs(pair.square) <= zero_square) free.push_back(pair);
  }
  // K is regular without free motions, and then the lowest are those nearest to 0.
  const double sigma = potential && free.empty() ? 0.0 : unit;
  if (sigma == 0.0) unit = std::sqrt(std::abs(lowest.front().square));

  Modes found{{}, Stability::stable, "every mode decays or vibrates with positive energy"};
  for (const Pair& pair : free) {
    const Vector u = pair.x.cwiseQuotient(root_of_masses(system));
    found.modes.push_back(scaled_mode(0.0, u.cast<std::complex<double>>()));
  }
  std::optional<QuadraticPair> fastest;
  if (free.size() < wanted) {
    const double counts_as_zero = sigma == 0.0 ? 0.0 : zero;
    const auto all = nearest_solutions(system, terms, sigma, unit, counts_as_zero, wanted - free.size());
    std::size_t zeros = 0;
    for (const QuadraticPair& pair : all) {
      if (std::abs(pair.s) <= counts_as_zero) ++zeros;
      if (std::abs(pair.s) > counts_as_zero && pair.s.imag() >= 0.0 && found.modes.size() < wanted) {
        found.modes.push_back(scaled_mode(pair.s, pair.u));
        found.modes.back().decays = pair.s.real() < -std::sqrt(epsilon) * std::abs(pair.s);
      }
      const double sure = pair.s.real() - pair.error;
      if (std::abs(pair.s) > counts_as_zero && pair.s.real() > 0.0 && pair.s.imag() >= 0.0 &&
          (!fastest || sure > fastest->s.real() - fastest->error))
        fastest = pair;
    }
    if (zeros != zeros_of(system, terms, free, zero))
      throw InvalidScene("Normal modes of scene \"" + system.layout()->scene +
                         "\": it cannot be told which of the lowest eigenvalues are 0 beside the largest "
                         "stiffness; leave out what is stiff and does not act on them, or make it rigid");
  }
  const char* why_not = nullptr;
  if (!positive || !nothing_below(system, terms, s, largest))
    why_not = "the stiffness is not known to be positive";
  if (!is_dissipative(system, terms)) why_not = "damping adds energy to some motions";
  if (!potential) why_not = "some forces have no potential";
  judge_many(found, fastest, why_not);
  return found;
}

}  // namespace

Modes lowest_modes(const System& system, const LinearTerms& terms, std::size_t wanted) {
  require_suitable(system, wanted);
  const double largest = stiffest(system, terms);
  const double s = largest > 0.0 ? constants.shift_below_0 * largest : 1.0;
  const bool damped = std::ranges::any_of(terms.damping, [](const auto& d) { return d.value() != 0.0; });
  const bool potential = circulatory(terms, system.coordinates()).nonZeros() == 0;
  Modes found = damped || !potential ? damped_modes(system, terms, s, largest, wanted)
                                     : conservative_modes(system, terms, s, largest, wanted);
  std::ranges::stable_sort(found.modes, {}, [](const Mode& m) { return std::abs(m.eigenvalue); });
  return found;
}

}  // namespace dalembert
