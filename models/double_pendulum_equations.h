#pragma once

#include <dalembert/models/double_pendulum.h>

#include <array>
#include <cmath>

namespace dalembert::models {

/// DoublePendulum's equations of motion in a real type, for its reference and, in double precision, to be
/// timed. The state is (p1, p2, p1', p2').
template <class T>
class DoublePendulumEquations {
 public:
  explicit DoublePendulumEquations(const DoublePendulum& p)
      : m1_(p.mass1),
        m2_(p.mass2),
        l1_(p.length1),
        l2_(p.length2),
        g_(p.gravity),
        start_{T(p.angle1), T(p.angle2), 0, 0} {}

  [[nodiscard]] std::array<T, 4> start() const { return start_; }
  void operator()(const auto& y, auto& y_rate) const {
    const Configuration at(y);
    const T w1 = y[2], w2 = y[3];
    const T upper = upper_acceleration(at, w1, w2);
    y_rate[0] = w1;
    y_rate[1] = w2;
    y_rate[2] = upper;
    y_rate[3] = (l1_ * (w1 * w1 * at.sine - upper * at.cosine) - g_ * at.sine2) / l2_;
  }
  [[nodiscard]] Observation<2> observation(const auto& y) const {
    const Configuration at(y);
    const T w1 = y[2], w2 = y[3];
    const T tension2 = m2_ * (g_ * at.cosine2 + l2_ * w2 * w2 + l1_ * w1 * w1 * at.cosine +
                              l1_ * upper_acceleration(at, w1, w2) * at.sine);
    const T tension1 = m1_ * (g_ * at.cosine1 + l1_ * w1 * w1) + tension2 * at.cosine;
    const VecOf<T, 2> upper = l1_ * vec(at.sine1, -at.cosine1);
    const VecOf<T, 2> lower = upper + l2_ * vec(at.sine2, -at.cosine2);
    return {.positions = {upper.template cast<double>(), lower.template cast<double>()},
            .forces = {static_cast<double>(tension1), static_cast<double>(tension2)}};
  }

 private:
  struct Configuration {
    explicit Configuration(const auto& y)
        : sine1(std::sin(T(y[0]))),
          cosine1(std::cos(T(y[0]))),
          sine2(std::sin(T(y[1]))),
          cosine2(std::cos(T(y[1]))),
          sine(sine1 * cosine2 - cosine1 * sine2),
          cosine(cosine1 * cosine2 + sine1 * sine2) {}
    T sine1, cosine1, sine2, cosine2;
    T sine, cosine;  // of p1 - p2
  };
  [[nodiscard]] T upper_acceleration(const Configuration& at, T w1, T w2) const {
    return (-m2_ * at.sine * (l2_ * w2 * w2 + l1_ * w1 * w1 * at.cosine) - (m1_ + m2_) * g_ * at.sine1 +
            m2_ * g_ * at.cosine * at.sine2) /
           (l1_ * (m1_ + m2_ * at.sine * at.sine));
  }

  T m1_, m2_, l1_, l2_, g_;
  std::array<T, 4> start_;
};

}  // namespace dalembert::models
