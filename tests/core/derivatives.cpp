#include "../finite_differences.h"
#include "dalembert/core/autodiff/functions.h"
#include <dalembert/core/vec.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace dalembert::derivatives_test {
namespace {

using std::abs, std::acos, std::acosh, std::asin, std::asinh, std::atan, std::atan2, std::atanh, std::cbrt,
    std::ceil, std::copysign, std::cos, std::cosh, std::erf, std::erfc, std::exp, std::exp2, std::expm1,
    std::fabs, std::fdim, std::floor, std::fmax, std::fmin, std::fmod, std::hypot, std::log, std::log10,
    std::log1p, std::log2, std::max, std::min, std::pow, std::round, std::sin, std::sinh, std::sqrt, std::tan,
    std::tanh, std::trunc;

/// A function of k variables as the library sees it.
template <int k>
struct Function {
  template <class T>
  using Arguments = VecOf<T, k>;

  std::string name;
  Arguments<double> x;
  double (*number)(const Arguments<double>&);
  Dual<k> (*dual)(const Arguments<Dual<k>>&);
  Jet<k> (*jet)(const Arguments<Jet<k>>&);
  HyperDual<k> (*tangent)(const Arguments<HyperDual<k>>&);

  template <class F>
  Function(std::string n, const Arguments<double>& at, F f)
      : name(std::move(n)), x(at), number(f), dual(f), jet(f), tangent(f) {}
};

/// Along s the inputs change at some rates, along the second of two at minus half of these.
template <class S, int k>
VecOf<S, k> inputs(const VecOf<double, k>& x, const VecOf<double, k>& rates) {
  VecOf<S, k> r;
  for (int i = 0; i < k; ++i) {
    if constexpr (S::along == 0) r[i] = S::input(x[i], i);
    if constexpr (S::along == 1) r[i] = S::input(x[i], i, rates[i]);
    if constexpr (S::along == 2) r[i] = S::input(x[i], i, typename S::Both{rates[i], -0.5 * rates[i]});
  }
  return r;
}

Eigen::VectorXd one(double x) { return Eigen::VectorXd::Constant(1, x); }
template <int k>
Eigen::VectorXd numbers(const detail::Lanes<k>& x) {
  Eigen::VectorXd all(k);
  for (int i = 0; i < k; ++i) all[i] = x[i];
  return all;
}

/// Value against the same formula in numbers, gradients against differences of the value, second derivatives
/// against differences of the first, along the axes and along a motion.
template <int k>
void expect_derivatives(const Function<k>& f) {
  VecOf<double, k> v;
  for (int i = 0; i < k; ++i) v[i] = 0.3 + 0.2 * i;
  const auto jet = [&](double s) { return f.jet(inputs<Jet<k>>(VecOf<double, k>(f.x + s * v), v)); };
  const auto tangent = [&](const VecOf<double, k>& x, const VecOf<double, k>& along) {
    return f.tangent(inputs<HyperDual<k>>(x, along));
  };
  const Jet<k> y = jet(0.0);
  const HyperDual<k> y_t = tangent(f.x, v);
  EXPECT_DOUBLE_EQ(y.value, f.number(f.x)) << f.name;
  EXPECT_EQ(y_t.value, y.value) << f.name;
  EXPECT_DOUBLE_EQ(y_t.s[0], y.s) << f.name;
  EXPECT_DOUBLE_EQ(y_t.s[1], -0.5 * y.s) << f.name;
  const Dual<k> y_z = f.dual(inputs<Dual<k>>(f.x, v));
  EXPECT_EQ(y_z.value, y.value) << f.name;
  expect_slope(slope([&](double s) { return one(jet(s).value); }), one(y.s), f.name + ": along the motion");
  expect_slope(slope([&](double s) { return one(jet(s).s); }), one(y.ss), f.name + ": twice");
  for (int j = 0; j < k; ++j) {
    const auto unit = VecOf<double, k>::Unit(j);
    const auto at = [&](double s) { return VecOf<double, k>(f.x + s * unit); };
    EXPECT_EQ(y_t.z[j], y.z[j]) << f.name;
    EXPECT_EQ(y_z.z[j], y.z[j]) << f.name;
    EXPECT_DOUBLE_EQ(y_t.zs[1][j], -0.5 * y_t.zs[0][j]) << f.name;
    expect_slope(slope([&](double s) { return one(f.number(at(s))); }), one(y.z[j]), f.name + ": gradient");
    expect_slope(slope([&](double s) { return numbers(tangent(at(s), v).z); }),
                 numbers(tangent(f.x, unit).zs[0]), f.name + ": second derivatives");
  }
}

/// u(x, y) with all first and second derivatives: f(u) then shows both terms of the chain rule.
auto inner(const auto& r) { return r[0] * r[1] + 0.1 * r[0] * r[0]; }

/// Where inner() is u.
Vec<2> where(double u) { return {1.0, u - 0.1}; }

TEST(Derivatives, EveryFunctionOfOneArgumentHasItsDerivatives) {
  const std::vector<Function<2>> functions{
      {"sqrt", where(0.7), [](const auto& r) { return sqrt(inner(r)); }},
      {"exp", where(0.7), [](const auto& r) { return exp(inner(r)); }},
      {"log", where(0.7), [](const auto& r) { return log(inner(r)); }},
      {"sin", where(0.7), [](const auto& r) { return sin(inner(r)); }},
      {"cos", where(0.7), [](const auto& r) { return cos(inner(r)); }},
      {"tan", where(0.7), [](const auto& r) { return tan(inner(r)); }},
      {"asin", where(-0.4), [](const auto& r) { return asin(inner(r)); }},
      {"acos", where(-0.4), [](const auto& r) { return acos(inner(r)); }},
      {"atan", where(-0.4), [](const auto& r) { return atan(inner(r)); }},
      {"sinh", where(0.7), [](const auto& r) { return sinh(inner(r)); }},
      {"cosh", where(0.7), [](const auto& r) { return cosh(inner(r)); }},
      {"tanh", where(0.7), [](const auto& r) { return tanh(inner(r)); }},
      {"exp2", where(0.7), [](const auto& r) { return exp2(inner(r)); }},
      {"expm1", where(0.7), [](const auto& r) { return expm1(inner(r)); }},
      {"log2", where(0.7), [](const auto& r) { return log2(inner(r)); }},
      {"log10", where(0.7), [](const auto& r) { return log10(inner(r)); }},
      {"log1p", where(-0.4), [](const auto& r) { return log1p(inner(r)); }},
      {"cbrt", where(0.7), [](const auto& r) { return cbrt(inner(r)); }},
      {"cbrt of a negative", where(-0.7), [](const auto& r) { return cbrt(inner(r)); }},
      {"asinh", where(-0.7), [](const auto& r) { return asinh(inner(r)); }},
      {"acosh", where(1.7), [](const auto& r) { return acosh(inner(r)); }},
      {"atanh", where(-0.4), [](const auto& r) { return atanh(inner(r)); }},
      {"erf", where(0.7), [](const auto& r) { return erf(inner(r)); }},
      {"erfc", where(0.7), [](const auto& r) { return erfc(inner(r)); }},
      {"fabs", where(-0.7), [](const auto& r) { return fabs(inner(r)); }},
      {"max with a smaller number", where(0.7), [](const auto& r) { return max(inner(r), 0.5) * inner(r); }},
      {"max with a larger number", where(0.7), [](const auto& r) { return max(0.9, inner(r)) * inner(r); }},
      {"min with a smaller number", where(0.7), [](const auto& r) { return min(0.5, inner(r)) * inner(r); }},
      {"min with a larger number", where(0.7), [](const auto& r) { return min(inner(r), 0.9) * inner(r); }},
      {"floor", where(1.7), [](const auto& r) { return floor(inner(r)) * inner(r); }},
      {"ceil", where(1.7), [](const auto& r) { return ceil(inner(r)) * inner(r); }},
      {"trunc", where(-1.7), [](const auto& r) { return trunc(inner(r)) * inner(r); }},
      {"round", where(1.7), [](const auto& r) { return round(inner(r)) * inner(r); }},
      {"abs of a negative", where(-0.7), [](const auto& r) { return abs(inner(r)); }},
      {"abs of a positive", where(0.7), [](const auto& r) { return abs(inner(r)); }},
      {"minus", where(0.7), [](const auto& r) { return -sin(inner(r)); }},
      {"pow -1.5", where(0.7), [](const auto& r) { return pow(inner(r), -1.5); }},
      {"pow 0", where(0.7), [](const auto& r) { return pow(inner(r), 0.0); }},
      {"pow 0.5", where(0.7), [](const auto& r) { return pow(inner(r), 0.5); }},
      {"pow 1", where(-0.7), [](const auto& r) { return pow(inner(r), 1.0); }},
      {"pow 2", where(-0.7), [](const auto& r) { return pow(inner(r), 2.0); }},
      {"pow 3", where(-0.7), [](const auto& r) { return pow(inner(r), 3.0); }},
      {"pow of an integer", where(-0.7), [](const auto& r) { return pow(inner(r), 2); }},
      {"number plus and minus", where(0.7), [](const auto& r) { return 2.0 - (inner(r) + 1.0 - 3.0); }},
      {"number times and over", where(0.7), [](const auto& r) { return 2.0 / (3.0 * inner(r) / 5.0); }},
  };
  for (const auto& f : functions) expect_derivatives(f);
}

TEST(Derivatives, EveryFunctionOfTwoArgumentsHasItsDerivatives) {
  const Vec<2> at{0.7, 0.4};
  const std::vector<Function<2>> functions{
      {"sum", at, [](const auto& r) { return sin(r[0]) + sin(r[1]); }},
      {"difference", at, [](const auto& r) { return sin(r[0]) - exp(r[1]); }},
      {"product", at, [](const auto& r) { return sin(r[0]) * exp(r[1]); }},
      {"quotient", at, [](const auto& r) { return sin(r[0]) / exp(r[0] * r[1]); }},
      {"pow", at, [](const auto& r) { return pow(r[0], r[1]); }},
      {"pow of a number", at, [](const auto& r) { return pow(2.0, r[1] * r[0]); }},
      {"hypot", at, [](const auto& r) { return hypot(r[0], r[0] * r[1]); }},
      {"hypot of three", at, [](const auto& r) { return hypot(r[0], r[0] * r[1], sin(r[1])); }},
      {"max, the first", at, [](const auto& r) { return max(sin(r[0]), sin(r[1])); }},
      {"max, the second", at, [](const auto& r) { return max(sin(r[1]), sin(r[0])); }},
      {"min, the first", at, [](const auto& r) { return min(sin(r[1]), sin(r[0])); }},
      {"min, the second", at, [](const auto& r) { return min(sin(r[0]), sin(r[1])); }},
      {"fmax", at, [](const auto& r) { return fmax(sin(r[0]), sin(r[1])); }},
      {"fmin", at, [](const auto& r) { return fmin(sin(r[0]), sin(r[1])); }},
      {"fdim, positive", at, [](const auto& r) { return fdim(sin(r[0]), sin(r[1])); }},
      {"fdim, zero", at, [](const auto& r) { return fdim(sin(r[1]), sin(r[0])); }},
      {"copysign, turned", at, [](const auto& r) { return copysign(sin(r[0]), -r[1]); }},
      {"copysign, kept", at, [](const auto& r) { return copysign(-sin(r[0]), -r[1]); }},
      {"copysign, positive", at, [](const auto& r) { return copysign(-sin(r[0]), r[1]); }},
      {"fmod", at, [](const auto& r) { return fmod(sin(r[0]), 0.5 * sin(r[1])); }},
      {"fmod of a negative", at, [](const auto& r) { return fmod(-sin(r[0]), 0.5 * sin(r[1])); }},
      {"atan2, first quadrant", at, [](const auto& r) { return atan2(r[0], r[1]); }},
      {"atan2, second quadrant", {0.7, -0.4}, [](const auto& r) { return atan2(r[0], r[1]); }},
      {"atan2, third quadrant", {-0.7, -0.4}, [](const auto& r) { return atan2(r[0], r[1]); }},
      {"atan2, fourth quadrant", {-0.7, 0.4}, [](const auto& r) { return atan2(r[0], r[1]); }},
      {"atan2 of a curve", at, [](const auto& r) { return atan2(r[0] * r[1], r[1] * r[1]); }},
      {"assignments", at,
       [](const auto& r) {
         auto x = r[0];
         x += r[1];
         x *= r[0];
         x -= 0.5 * r[1];
         x /= r[1];
         return x;
       }},
  };
  for (const auto& f : functions) expect_derivatives(f);
}

TEST(Derivatives, VectorAlgebraHasThoseOfItsFormulas) {
  using Six = VecOf<double, 6>;
  const Six at{0.3, -0.7, 1.1, 0.9, 0.2, -0.5};
  const std::vector<Function<6>> functions{
      {"norm", at, [](const auto& r) { return (r.template head<3>() - r.template tail<3>()).norm(); }},
      {"squared norm", at, [](const auto& r) { return r.squaredNorm(); }},
      {"dot", at, [](const auto& r) { return r.template head<3>().dot(r.template tail<3>()); }},
      {"cross", at, [](const auto& r) { return r.template head<3>().cross(r.template tail<3>()).norm(); }},
      {"normalized", at,
       [](const auto& r) { return r.template head<3>().normalized().dot(r.template tail<3>()); }},
      {"dot with numbers", at,
       [](const auto& r) {
         return Vec<3>{1.0, 2.0, 3.0}.normalized().dot(r.template head<3>());
       }},
      {"cross with numbers", at,
       [](const auto& r) {
         return Vec<3>{1.0, 2.0, 3.0}.cross(r.template head<3>()).norm();
       }},
      {"numbers subtracted and scaled", at,
       [](const auto& r) {
         return (2.0 * (r.template head<3>() - Vec<3>{1.0, 2.0, 3.0}) / 3.0).norm();
       }},
      {"sum of components", at, [](const auto& r) { return r.sum() * r.x() / r[1]; }},
  };
  for (const auto& f : functions) expect_derivatives(f);
}

TEST(Derivatives, AutoTypedPartsOfAFormulaOutliveTheirExpression) {
  using S = HyperDual<2>;
  const S x = S::input(3.0, 0, S::Both{1.0, 0.0});
  const S y = S::input(4.0, 1);
  auto s = x * y + 1.0;  // with expression templates: a reference to the dead x * y
  auto r = s * s - 2.0 * (x + y);
  EXPECT_EQ(r.value, 13.0 * 13.0 - 14.0);
  EXPECT_EQ(r.z[0], 2.0 * 13.0 * 4.0 - 2.0);
  EXPECT_EQ(r.z[1], 2.0 * 13.0 * 3.0 - 2.0);
  EXPECT_EQ(r.zs[0][1], 2.0 * 13.0 + 2.0 * 3.0 * 4.0);
}

TEST(Derivatives, PowersAtZeroHaveTheirLimits) {
  using S = Jet<1>;
  const S zero = S::input(0.0, 0, 1.0);
  const auto is = [](const S& f, double value, double slope, double curvature) {
    return f.value == value && f.z[0] == slope && f.s == slope && f.ss == curvature;
  };
  EXPECT_TRUE(is(pow(zero, 0.0), 1.0, 0.0, 0.0));
  EXPECT_TRUE(is(pow(zero, 1.0), 0.0, 1.0, 0.0));
  EXPECT_TRUE(is(pow(zero, 2.0), 0.0, 0.0, 2.0));
  EXPECT_TRUE(is(pow(zero, 3.0), 0.0, 0.0, 0.0));
}

TEST(Derivatives, SignedZerosAndTiesGoAsInStd) {
  using S = Jet<1>;
  EXPECT_EQ(copysign(S(2.0), S(-0.0)).value, std::copysign(2.0, -0.0));
  EXPECT_EQ(copysign(S(2.0), S(0.0)).value, 2.0);
  // What is not a number is never lost.
  const S none(std::numeric_limits<double>::quiet_NaN());
  for (const S& m : {max(none, S(0.0)), max(S(0.0), none), min(none, S(0.0)), min(S(0.0), none)})
    EXPECT_TRUE(std::isnan(m.value));
  for (const double m : {dalembert::max(none.value, 0.0), dalembert::max(0.0, none.value),
                         dalembert::min(none.value, 0.0), dalembert::min(0.0, none.value)})
    EXPECT_TRUE(std::isnan(m));
  // std::max and std::min return their first argument where both are equal.
  EXPECT_EQ(max(S::input(1.0, 0), S(1.0)).z[0], 1.0);
  EXPECT_EQ(max(S(1.0), S::input(1.0, 0)).z[0], 0.0);
  EXPECT_EQ(min(S::input(1.0, 0), S(1.0)).z[0], 1.0);
  EXPECT_EQ(min(S(1.0), S::input(1.0, 0)).z[0], 0.0);
}

TEST(Derivatives, ReportEveryKinkAndJump) {
  using S = Jet<1>;
  const auto recorded = [](double x, auto f) {
    Branches::Sides recorded;
    const Branches listen(&recorded, nullptr);
    Branches::enter_batch(0);
    (void)f(S::input(x, 0));
    std::vector<std::pair<int, double>> outcomes;
    for (const auto& one : recorded[0]) outcomes.push_back({one.side, one.piece});
    return outcomes;
  };
  const auto tells = [&recorded](double before, double behind, auto f) {
    return recorded(before, f) != recorded(behind, f) &&
           recorded(before, f) == recorded(std::nextafter(before, -9.0), f);
  };
  EXPECT_TRUE(tells(0.9, 1.1, [](const S& x) { return max(x, 1.0); }));
  EXPECT_TRUE(tells(0.9, 1.1, [](const S& x) { return min(x, 1.0); }));
  EXPECT_TRUE(tells(0.9, 1.1, [](const S& x) { return fdim(x, 1.0); }));
  EXPECT_TRUE(tells(-0.1, 0.1, [](const S& x) { return copysign(S(2.0), x); }));
  EXPECT_TRUE(tells(-0.1, 0.1, [](const S& x) { return fabs(x); }));
  EXPECT_TRUE(tells(0.9, 1.1, [](const S& x) { return floor(x); }));
  EXPECT_TRUE(tells(0.9, 1.1, [](const S& x) { return ceil(x); }));
  EXPECT_TRUE(tells(0.9, 1.1, [](const S& x) { return trunc(x); }));
  EXPECT_TRUE(tells(0.4, 0.6, [](const S& x) { return round(x); }));
  EXPECT_TRUE(tells(0.9, 1.1, [](const S& x) { return fmod(x, 1.0); }));
  EXPECT_EQ(recorded(0.9, [](const S& x) { return exp(x); }),
            recorded(1.1, [](const S& x) { return exp(x); }));
}

TEST(Derivatives, SingularOnesAreNotFinite) {
  using S = Jet<1>;
  EXPECT_FALSE(isfinite(sqrt(S::input(0.0, 0))));
  EXPECT_FALSE(isfinite(log(S::input(0.0, 0))));
  EXPECT_FALSE(isfinite(cbrt(S::input(0.0, 0))));
  EXPECT_FALSE(isfinite(acosh(S::input(1.0, 0))));
  EXPECT_FALSE(isfinite(atanh(S::input(1.0, 0))));
  EXPECT_FALSE(isfinite(asin(S::input(1.0, 0))));
  EXPECT_FALSE(isfinite(hypot(S::input(0.0, 0), S(0.0))));
  EXPECT_FALSE(isfinite(1.0 / S::input(0.0, 0)));
  EXPECT_TRUE(isfinite(abs(S::input(0.0, 0))));
}

TEST(Derivatives, DoNotEnterComparisons) {
  using S = Jet<1>;
  const S two = S::input(2.0, 0);
  EXPECT_TRUE(two == S(2.0));
  EXPECT_TRUE(two == 2.0);
  EXPECT_TRUE(1.0 < two && two < 3.0 && two <= S(2.0) && two > S(1.0));
  EXPECT_EQ(std::max(S(1.0), two).z[0], 1.0);
}

TEST(Derivatives, MixWithNumbersInAVector) {
  using S = Jet<1>;
  const auto r = vec(S::input(2.0, 0), 3.0, 4);
  static_assert(std::is_same_v<decltype(r), const VecOf<S, 3>>);
  EXPECT_EQ(r[0].z[0], 1.0);
  EXPECT_EQ(r[1].value, 3.0);
  EXPECT_EQ(r[2].value, 4.0);
}

}  // namespace
}  // namespace dalembert::derivatives_test
