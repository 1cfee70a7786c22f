#pragma once

#include <dalembert/core/vec.h>

#include <cmath>
#include <limits>
#include <stdexcept>

/// What a user's scene may hold as functions: motions in time, and faults that go off.
namespace dalembert::fuzz {

/// offset + amplitude sin(omega (t - start)): at `start` it is `offset`.
struct Swing {
  double offset = 0.0, amplitude = 0.0, omega = 0.0, start = 0.0;

  template <class S>
  S operator()(const S& t) const {
    using std::sin;
    return S(offset + amplitude * sin(omega * (t - start)));
  }
};

/// The same of a point, about `centre`.
template <int D>
struct SwingingPath {
  Vec<D> centre = Vec<D>::Zero(), amplitude = Vec<D>::Zero();
  double omega = 0.0, start = 0.0;

  template <class S>
  VecOf<S, D> operator()(const S& t) const {
    using std::sin;
    const S s = sin(omega * (t - start));
    VecOf<S, D> r;
    for (int k = 0; k < D; ++k) r[k] = S(centre[k] + amplitude[k] * s);
    return r;
  }
};

/// Goes off at a time: from then on it throws, or turns what it is multiplied with into no number.
struct Fuse {
  enum class Kind { none, throws, throws_an_int, not_a_number, infinite };
  Kind kind = Kind::none;
  double time = 0.0;

  template <class S>
  double operator()(const S& t) const {
    if (kind == Kind::none || !(t > time)) return 1.0;
    switch (kind) {
      case Kind::throws:
        throw std::runtime_error("the fuse went off");
      case Kind::throws_an_int:
        throw 42;
      case Kind::not_a_number:
        return std::numeric_limits<double>::quiet_NaN();
      default:
        return std::numeric_limits<double>::infinity();
    }
  }
};

}  // namespace dalembert::fuzz
