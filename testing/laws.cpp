#include "dalembert/testing/laws.h"

#include <dalembert/core/errors.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <exception>
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

/// What the equations give at one instant.
struct Values {
  VectorXd F, g, psi, gamma, forces, w;  // forces: F + W^T lambda; w: W in the order of its pattern
};
using Part = VectorXd Values::*;
constexpr std::array<Part, 4> parts = {&Values::F, &Values::g, &Values::psi, &Values::forces};

/// A derivative by central differences, and a bound of its error.
struct Difference {
  double value = 0.0, error = std::numeric_limits<double>::infinity();
};

/// Equations at s = -2h, -h, h and 2h along a direction.
struct Stencil {
  double h;
  std::array<Values, 4> at;
};

/// An equation's error from its round-off is that of this many operations on numbers as large as its terms.
constexpr double operations = 32.0 * std::numeric_limits<double>::epsilon();

double largest(const VectorXd& x, std::span<const char> angles, bool of_angles) {
  double most = 0.0;
  for (Index i = 0; i < x.size(); ++i)
    if ((angles[static_cast<std::size_t>(i)] != 0) == of_angles) most = std::max(most, std::abs(x[i]));
  return most;
}

double or_else(double size, double other) { return size > 0.0 ? size : other; }

double extent_of(const System& system, double t) {
  const double extent = system.extent(t);
  return std::isfinite(extent) ? extent : 0.0;
}

/// Of what moves: the scene's extent, or what there is of a lone particle, its distance from the origin.
double length_of(const System& system, double t, const VectorXd& q) {
  return or_else(extent_of(system, t), or_else(largest(q, system.angles(), false), 1.0));
}

/// The last binary digit that a number has; infinite for 0.
double last_bit(double x) {
  if (x == 0.0 || !std::isfinite(x)) return std::numeric_limits<double>::infinity();
  int exponent = 0;
  constexpr int digits = std::numeric_limits<double>::digits;
  const double fraction = std::frexp(std::abs(x), &exponent);
  const int zeros = std::countr_zero(static_cast<std::uint64_t>(std::ldexp(fraction, digits)));
  return std::ldexp(1.0, exponent - digits + zeros);
}

/// Numbers of no special kind, between -1 and 1.
double generic(std::size_t i) { return std::sin(1.3 * static_cast<double>(i) + 0.7); }

/// Holds a System's derivatives against central differences of its own values.
class DerivativeCheck {
 public:
  DerivativeCheck(const System& system, const Instant& at, std::span<const double> lambda)
      : system_(system), t_(at.t), q_(as_vector(at.q)), v_(as_vector(at.v)), lambda_(as_vector(lambda)) {}

  std::string run() {
    now_ = values(t_, q_, v_, lambda_);
    check_bits();
    find_sizes();
    auto d = system_.linearisation();
    system_.linearise({t_, flat(q_), flat(v_)}, flat(lambda_), d);
    const MatrixXd W = by_rows(flat(now_.w)), psi_q = by_rows(d.psi_q),
                   stiffness = by_entries(system_.stiffness_pattern(), d.stiffness),
                   damping = by_entries(system_.forces().damping_pattern(), d.damping);
    const Index holonomic = as_index(system_.holonomic_rows());
    const std::vector<char> angles = system_.angles();
    const double length = length_of(system_, t_, q_), far = std::max(length, largest(q_, angles, false));
    const double speed = or_else(largest(v_, angles, false), length),
                 turning = or_else(largest(v_, angles, true), 1.0);
    for (Index j = 0; j < q_.size(); ++j) {
      const bool angle = angles[static_cast<std::size_t>(j)] != 0;
      const VectorXd e = VectorXd::Unit(q_.size(), j);
      const auto moved = stencils([&](double s) { return values(t_, q_ + s * e, v_, lambda_); },
                                  angle ? 1.0 : far, angle ? 1.0 : length);
      compare(moved, &Values::g, W.col(j).head(holonomic), "W = dg/dq", j);
      compare(moved, &Values::psi, psi_q.col(j), "dpsi/dq", j);
      compare(moved, &Values::forces, stiffness.col(j), "d(F + W^T lambda)/dq", j);
      const double unit = angle ? turning : speed;
      const auto kicked = stencils([&](double s) { return values(t_, q_, v_ + s * e, lambda_); }, unit, unit);
      compare(kicked, &Values::psi, W.col(j), "W = dpsi/dv", j);
      compare(kicked, &Values::F, damping.col(j), "dF/dv", j);
    }
    MatrixXd by_lambda = MatrixXd::Zero(q_.size(), lambda_.size());
    const auto pattern = system_.forces().friction_pattern();
    for (std::size_t k = 0; k < pattern.size(); ++k)
      by_lambda(as_index(pattern[k].row), as_index(pattern[k].column)) += d.friction[k];
    const double force = lambda_.size() > 0 ? or_else(lambda_.cwiseAbs().maxCoeff(), 1.0) : 1.0;
    for (Index r = 0; r < lambda_.size(); ++r) {
      const VectorXd e = VectorXd::Unit(lambda_.size(), r);
      const auto pressed =
          stencils([&](double s) { return values(t_, q_, v_, lambda_ + s * e); }, force, force);
      compare(pressed, &Values::F, by_lambda.col(r), "dF/dlambda", r);
    }
    const double time = std::min(length / speed, 1.0 / turning);
    const auto later = stencils([&](double s) { return values(t_ + s, q_ + s * v_, v_, lambda_); },
                                std::max(time, far / speed), time);
    compare(later, &Values::g, now_.psi.head(holonomic), "psi = dg/dt", 0);
    compare(later, &Values::psi, now_.gamma, "gamma = dpsi/dt", 0);
    return found_.str();
  }

 private:
  [[nodiscard]] MatrixXd by_rows(std::span<const double> w) const {
    MatrixXd dense = MatrixXd::Zero(as_index(system_.rows()), as_index(system_.coordinates()));
    for (std::size_t r = 0; r < system_.rows(); ++r)
      for (const std::size_t k : system_.row(r)) dense(as_index(r), as_index(system_.w_columns()[k])) += w[k];
    return dense;
  }
  [[nodiscard]] MatrixXd by_entries(std::span<const MatrixEntry> pattern,
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
    system_.forces().add_friction(at, flat(lambda), e.force);
    const VectorXd F = as_vector(e.force);
    VectorXd forces = F;
    for (std::size_t r = 0; r < system_.rows(); ++r)
      for (const std::size_t k : system_.row(r))
        forces[as_index(system_.w_columns()[k])] += e.w[k] * lambda[as_index(r)];
    return {F, as_vector(e.g), as_vector(e.psi), as_vector(gamma), forces, as_vector(e.w)};
  }

  void check_bits() {
    const Values again = values(t_, q_, v_, lambda_);
    if (now_.F == again.F && now_.g == again.g && now_.psi == again.psi && now_.gamma == again.gamma &&
        now_.w == again.w)
      return;
    add("a second evaluation gives other numbers");
  }

  /// How large an equation's terms are, by what a relative change of its arguments makes of it:
  ///
  ///   |f| + sum |x_k df/dx_k|   over x = t, q, v, lambda
  ///
  /// A rounding of x_k moves it by as much of that. Lengths count as the scene's extent at least: points that
  /// are held have no coordinates. Changes are 2^-26 of the scene, so that neither round-off nor curvature
  /// counts.
  void find_sizes() {
    const std::vector<char> angles = system_.angles();
    const double extent = extent_of(system_, t_), length = length_of(system_, t_, q_);
    const double part = 0x1p-26 * std::min(1.0, length / or_else(largest(q_, angles, false), length));
    for (std::size_t p = 0; p < parts.size(); ++p) sizes_[p] = (now_.*parts[p]).cwiseAbs();
    const auto add = [&](const Values& changed) {
      for (std::size_t p = 0; p < parts.size(); ++p)
        sizes_[p] += (changed.*parts[p] - now_.*parts[p]).cwiseAbs() / part;
    };
    const auto each = [&](VectorXd& x, const auto& size, const auto& evaluate) {
      for (Index k = 0; k < x.size(); ++k) {
        const double own = std::exchange(x[k], x[k] + part * size(k));
        add(evaluate());
        x[k] = own;
      }
    };
    VectorXd q = q_, v = v_, lambda = lambda_;
    const auto evaluate = [&] { return values(t_, q, v, lambda); };
    const auto size_of_q = [&](Index k) {
      return std::max(std::abs(q_[k]), angles[static_cast<std::size_t>(k)] ? 0.0 : extent);
    };
    add(values(t_ * (1.0 + part), q_, v_, lambda_));
    each(q, size_of_q, evaluate);
    each(
        v, [&](Index k) { return v_[k]; }, evaluate);
    each(
        lambda, [&](Index k) { return lambda_[k]; }, evaluate);
    see_last_bits(length);
  }

  /// A difference of large numbers, as of the distance from a centre far away and a radius, has no bits below
  /// their last one. So the last bit of an equation that varies is that of its largest term.
  void see_last_bits(double length) {
    const std::vector<char> angles = system_.angles();
    std::vector<Values> all;
    for (double h = 0.1; h > 1e-5; h *= 0.1) {
      VectorXd q = q_;
      for (Index k = 0; k < q.size(); ++k)
        q[k] += (angles[static_cast<std::size_t>(k)] ? h : h * length) * generic(static_cast<std::size_t>(k));
      try {
        all.push_back(values(t_, q, v_, lambda_));
      } catch (const EquationFault&) {  // beyond where the equations are defined
      }
    }
    for (std::size_t p = 0; p < parts.size(); ++p) {
      for (Index i = 0; i < sizes_[p].size(); ++i) {
        const double here = (now_.*parts[p])[i];
        bool varies = false;
        double bit = last_bit(here);
        for (const Values& there : all) {
          varies = varies || (there.*parts[p])[i] != here;
          bit = std::min(bit, last_bit((there.*parts[p])[i]));
        }
        if (varies) sizes_[p][i] = std::max(sizes_[p][i], bit / std::numeric_limits<double>::epsilon());
      }
    }
  }

  /// The steps that a derivative is looked for with, the finest first: tenths from the largest size that the
  /// scene has down to 1e-9 of the smallest. Steps that leave where the equations are defined are left out.
  [[nodiscard]] static std::vector<Stencil> stencils(const std::function<Values(double)>& f, double largest,
                                                     double smallest) {
    std::vector<Stencil> all;
    constexpr double least = std::numeric_limits<double>::min();
    std::exception_ptr fault;
    for (double h = std::max(least, 1e-9 * smallest); h < 0.5 * largest; h *= 10.0) {
      try {
        all.push_back({h, {f(-2.0 * h), f(-h), f(h), f(2.0 * h)}});
      } catch (const EquationFault&) {
        fault = std::current_exception();
      }
    }
    if (all.empty()) std::rethrow_exception(fault);
    return all;
  }

  ///   D(h) = (f(h) - f(-h)) / 2h = f' + h^2 f'''/6 + O(h^4),
  ///
  /// so |D(2h) - D(h)| is three times the truncation error of D(h). Round-off adds the error of f over h, of
  /// operations on terms as large as they are found to be. Of all steps the one counts that errs least by
  /// this. A step that a finer one contradicts steps over something, and so does one that is truncated less.
  [[nodiscard]] Difference difference(const std::vector<Stencil>& stencils, Part f, Index i) const {
    const auto p = static_cast<std::size_t>(std::find(parts.begin(), parts.end(), f) - parts.begin());
    std::vector<Difference> all;
    double finer = 0.0;  // the truncation error of the step before, as far as it is no round-off
    for (const Stencil& s : stencils) {
      const auto y = [&](std::size_t k) { return (s.at[k].*f)[i]; };
      const double fine = (y(2) - y(1)) / (2.0 * s.h), coarse = (y(3) - y(0)) / (4.0 * s.h);
      const double size =
          std::max({sizes_[p][i], std::abs(y(0)), std::abs(y(1)), std::abs(y(2)), std::abs(y(3))});
      const double truncation = std::abs(coarse - fine), round_off = operations * size / s.h;
      const Difference here{fine, truncation + round_off};
      const bool falls = finer <= truncation;
      finer = truncation - round_off;
      if (falls && std::all_of(all.begin(), all.end(), [&here](const Difference& known) {
            return std::abs(known.value - here.value) <= known.error + here.error;
          }))
        all.push_back(here);
    }
    return *std::min_element(all.begin(), all.end(),
                             [](const Difference& a, const Difference& b) { return a.error < b.error; });
  }

  void compare(const std::vector<Stencil>& stencils, Part f, const VectorXd& derived, const char* law,
               Index place) {
    for (Index i = 0; i < derived.size(); ++i) {
      const Difference expected = difference(stencils, f, i);
      if (std::abs(derived[i] - expected.value) <= expected.error) continue;
      std::ostringstream what;
      what.precision(10);
      what << law << ", entry " << i << ", " << place << ": " << derived[i]
           << " is not the difference quotient " << expected.value << " +- " << expected.error;
      const bool of_row = f == &Values::g || f == &Values::psi;
      if (of_row) what << " (" << system_.row_label(static_cast<std::size_t>(i)) << ')';
      return add(what.str());
    }
  }

  void add(const std::string& what) { found_ << (found_.str().empty() ? "" : "; ") << what; }

  const System& system_;
  double t_;
  VectorXd q_, v_, lambda_;
  Values now_{};
  std::array<VectorXd, parts.size()> sizes_{};
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
  const double length = length_of(system, 0.0, as_vector(q));
  std::vector<double> v(v0.begin(), v0.end()), lambda(system.rows());
  for (std::size_t i = 0; i < v.size(); ++i) v[i] += length * generic(i);
  // As large as the forces, so that neither hides in the round-off of the other.
  auto e = system.evaluation();
  system.evaluate({0.0, q, v}, e);
  double force = 0.0;
  for (const double F : e.force) force = std::max(force, std::abs(F));
  for (std::size_t r = 0; r < lambda.size(); ++r) lambda[r] = or_else(force, 1.0) * (1.0 + generic(r));
  return broken_laws(system, {0.0, q, v}, lambda);
}

template std::string broken_laws(const Scene<2>&);
template std::string broken_laws(const Scene<3>&);

}  // namespace dalembert
