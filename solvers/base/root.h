#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

/// Where f is 0 between a and b, at which it has different signs (or is 0 at b): by false position with
/// Illinois' modification, order 1.44: the value at an end that stays for a second time is halved (Dowell,
/// Jarratt, BIT 11 (1971) 168). Where four steps do not halve the bracket, as at a jump, it is halved. Ends
/// where it is no longer than `exact`, on the side of b.
template <class F>
[[nodiscard]] double root(const F& f, double a, double f_a, double b, double f_b, double exact) {
  if (f_b == 0.0) return b;
  double half = 0.5 * std::abs(b - a);
  int kept = 0;  // the end that the last step left: -1 for a, 1 for b
  for (int steps = 1; std::abs(b - a) > exact; ++steps) {
    double x = (a * f_b - b * f_a) / (f_b - f_a);
    if (steps % 5 == 0) {
      if (std::abs(b - a) > half) x = 0.5 * (a + b);
      half = 0.5 * std::abs(b - a);
    }
    if (!(x > std::min(a, b) && x < std::max(a, b))) x = 0.5 * (a + b);
    if (x == a || x == b) return b;  // adjacent numbers
    const double f_x = f(x);
    if (f_x == 0.0) return x;
    if ((f_x > 0.0) == (f_b > 0.0)) {
      b = x;
      f_b = f_x;
      if (std::exchange(kept, -1) == -1) f_a *= 0.5;
    } else {
      a = x;
      f_a = f_x;
      if (std::exchange(kept, 1) == 1) f_b *= 0.5;
    }
  }
  return b;
}

}  // namespace dalembert
