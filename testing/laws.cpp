#include "dalembert/testing/laws.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Index as_index(std::size_t i) { return static_cast<Index>(i); }
std::span<const double> flat(const VectorXd& x) { return {x.data(), static_cast<std::size_t>(x.size())}; }
VectorXd as_vector(std::span<const double> x) {
  return Eigen::Map<const VectorXd>(x.data(), as_index(x.size()));
}

/// A derivative by central differences, and a bound of its error.
struct Difference {
  VectorXd value, error;
};

/// Holds a System's derivatives against central differences of its own values.
class DerivativeCheck {
 public:
  DerivativeCheck(const System& system, const Instant& at, std::span<const double> lambda)
      : system_(system), t_(at.t), q_(as_vector(at.q)), v_(as_vector(at.v)), lambda_(as_vector(lambda)) {
    const auto angles = system.angles();
    double length = 0.0;
    for (Index i = 0; i < q_.size(); ++i)
      if (!angles[static_cast<std::size_t>(i)]) length = std::max(length, std::abs(q_[i]));
    if (length == 0.0) length = 1.0;
    for (const char angle : angles) unit_.push_back(angle ? 1.0 : length);
  }

  std::string run() {
    const Values now = values(t_, q_, v_, lambda_);
    check_bits(now);
    auto d = system_.linearisation();
    system_.linearise({t_, flat(q_), flat(v_)}, flat(lambda_), d);
    const MatrixXd psi_q = by_rows(d.psi_q), stiffness = by_entries(system_.stiffness_pattern(), d.stiffness),
                   damping = by_entries(system_.damping_pattern(), d.damping);
    const Index holonomic = as_index(system_.holonomic_rows());
    for (Index j = 0; j < q_.size(); ++j) {
      const VectorXd e = VectorXd::Unit(q_.size(), j) * unit_[static_cast<std::size_t>(j)];
      const auto moved = [&](double s) { return values(t_, q_ + s * e, v_, lambda_); };
      const auto kicked = [&](double s) { return values(t_, q_, v_ + s * e, lambda_); };
      const double u = unit_[static_cast<std::size_t>(j)];
      compare([&](double s) { return moved(s).g; }, u * now.W.col(j).head(holonomic), "W = dg/dq", j);
      compare([&](double s) { return kicked(s).psi; }, u * now.W.col(j), "W = dpsi/dv", j);
      compare([&](double s) { return moved(s).psi; }, u * psi_q.col(j), "dpsi/dq", j);
      compare([&](double s) { return moved(s).force(lambda_); }, u * stiffness.col(j), "d(F + W^T lambda)/dq",
              j);
      compare([&](double s) { return kicked(s).F; }, u * damping.col(j), "dF/dv", j);
    }
    MatrixXd by_lambda = MatrixXd::Zero(q_.size(), lambda_.size());
    const auto pattern = system_.multiplier_force_pattern();
    for (std::size_t k = 0; k < pattern.size(); ++k)
      by_lambda(as_index(pattern[k].row), as_index(pattern[k].column)) += d.friction[k];
    for (Index r = 0; r < lambda_.size(); ++r)
      compare([&](double s) { return values(t_, q_, v_, lambda_ + s * VectorXd::Unit(lambda_.size(), r)).F; },
              by_lambda.col(r), "dF/dlambda", r);
    const auto later = [&](double s) { return values(t_ + s, q_ + s * v_, v_, lambda_); };
    compare([&](double s) { return later(s).g; }, now.psi.head(holonomic), "psi = dg/dt", 0);
    compare([&](double s) { return later(s).psi; }, now.gamma, "gamma = dpsi/dt", 0);
    return found_.str();
  }

 private:
  struct Values {
    VectorXd F, g, psi, gamma;
    MatrixXd W;

    [[nodiscard]] VectorXd force(const VectorXd& lambda) const { return F + W.transpose() * lambda; }
  };

  [[nodiscard]] MatrixXd by_rows(std::span<const double> w) const {
    MatrixXd dense = MatrixXd::Zero(as_index(system_.rows()), as_index(system_.coordinates()));
    for (std::size_t r = 0; r < system_.rows(); ++r)
      for (const std::size_t k : system_.row(r)) dense(as_index(r), as_index(system_.w_columns()[k])) += w[k];
    return dense;
  }
  [[nodiscard]] MatrixXd by_entries(std::span<const System::Entry> pattern,
                                    std::span<const double> values) const {
    MatrixXd dense = MatrixXd::Zero(q_.size(), q_.size());
    for (std::size_t k = 0; k < pattern.size(); ++k)
      dense(as_index(pattern[k].row), as_index(pattern[k].column)) += values[k];
    return dense;
  }
  [[nodiscard]] Values values(double t, const VectorXd& q, const VectorXd& v, const VectorXd& lambda) const {
    const Instant at{t, flat(q), flat(v)};
    auto e = system_.evaluation();
    std::vector<double> gamma(system_.rows());
    system_.evaluate_with_bias(at, e, gamma);
    system_.add_multiplier_forces(at, flat(lambda), e.force);
    return {as_vector(e.force), as_vector(e.g), as_vector(e.psi), as_vector(gamma), by_rows(e.w)};
  }

  void check_bits(const Values& now) {
    const Values again = values(t_, q_, v_, lambda_);
    if (now.F == again.F && now.g == again.g && now.psi == again.psi && now.gamma == again.gamma &&
        now.W == again.W)
      return;
    add("a second evaluation gives other numbers");
  }

  ///   D(h) = (f(h) - f(-h)) / 2h = f' + h^2 f'''/6 + O(h^4),
  ///
  /// so |D(2h) - D(h)| is three times the truncation error of D(h). Round-off adds the error of f over h; f
  /// is taken for 32 roundings of numbers ten times its size, or of 10. At h = 1e-5, about the cube root of a
  /// rounding, both are about 1e-10 for functions of size 1.
  [[nodiscard]] static Difference difference(const std::function<VectorXd(double)>& f) {
    constexpr double h = 1e-5, operations = 32.0;
    const auto over = [&f](double step) { return VectorXd((f(step) - f(-step)) / (2.0 * step)); };
    const VectorXd fine = over(h), size = f(0.0);
    const double largest = size.size() > 0 ? std::max(size.cwiseAbs().maxCoeff(), 1.0) : 1.0;
    const double round_off = operations * std::numeric_limits<double>::epsilon() * 10.0 * largest / h;
    return {fine, ((over(2.0 * h) - fine).array().abs() + round_off).matrix()};
  }

  void compare(const std::function<VectorXd(double)>& f, const VectorXd& derived, const char* law,
               Index place) {
    const Difference expected = difference(f);
    for (Index i = 0; i < derived.size(); ++i) {
      if (std::abs(derived[i] - expected.value[i]) <= expected.error[i]) continue;
      std::ostringstream what;
      what.precision(10);
      what << law << ", entry " << i << ", " << place << ": " << derived[i]
           << " is not the difference quotient " << expected.value[i] << " +- " << expected.error[i];
      const bool of_row = derived.size() == as_index(system_.rows());
      if (of_row) what << " (" << system_.row_label(static_cast<std::size_t>(i)) << ')';
      return add(what.str());
    }
  }

  void add(const std::string& what) { found_ << (found_.str().empty() ? "" : "; ") << what; }

  const System& system_;
  double t_;
  VectorXd q_, v_, lambda_;
  std::vector<double> unit_;
  std::ostringstream found_;
};

}  // namespace

std::string broken_laws(const System& system, const Instant& at, std::span<const double> lambda) {
  return DerivativeCheck(system, at, lambda).run();
}

template <int D>
std::string broken_laws(const Scene<D>& scene) {
  const System system = scene.system();
  const auto q = scene.initial_positions(), v0 = scene.initial_velocities();
  double length = 0.0;
  for (const double x : q) length = std::max(length, std::abs(x));
  const auto generic = [](std::size_t i) { return std::sin(1.3 * static_cast<double>(i) + 0.7); };
  std::vector<double> v(v0.begin(), v0.end()), lambda(system.rows());
  for (std::size_t i = 0; i < v.size(); ++i) v[i] += (length > 0.0 ? length : 1.0) * generic(i);
  for (std::size_t r = 0; r < lambda.size(); ++r) lambda[r] = 1.0 + generic(r);
  return broken_laws(system, {0.0, q, v}, lambda);
}

template std::string broken_laws(const Scene<2>&);
template std::string broken_laws(const Scene<3>&);

}  // namespace dalembert
