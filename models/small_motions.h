#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dalembert::models {

/// A number that `equilibrium` or `normal_modes` gave, and its closed form.
struct Compared {
  std::string model;     ///< as in the catalogue
  std::string quantity;  ///< "omega", "tension", ...
  double value;
  double reference;  ///< from a closed form
  double limit;      ///< of `error`

  /// Relative; of a reference 0, absolute.
  [[nodiscard]] double error() const;
};

/// The rows of one model.
class Rows {
 public:
  Rows(std::vector<Compared>& all, std::string model) : all_(all), model_(std::move(model)) {}
  /// Closed forms are compared to 1e-10; what multipliers known to 1e-11 tell to less (see tests/solvers).
  void add(const std::string& quantity, double value, double reference, double limit = 1e-10) {
    all_.push_back({model_, quantity, value, reference, limit});
  }

 private:
  std::vector<Compared>& all_;
  std::string model_;
};

/// Equilibria, forces of constraint there and small motions of the systems of the notes that have them in
/// closed form. Each system states its own in its header; those that are stated nowhere else:
///
///   double pendulum:   m1 l1 l2 w^2 - (m1 + m2) g (l1 + l2) w + (m1 + m2) g^2 = 0,  w = omega^2
///   conical pendulum:  cos theta = g/(l Omega^2), tension m l Omega^2, omega^2 = Omega^2 (1 + 3 cos^2 theta)
///   cone:              r = g cot a/Omega^2, normal force m g/sin a, omega^2 = 3 Omega^2 sin^2 a
///   rod on a track, hanging:  omega^2 = 6 g/l, from its Routhian
///   pendulum upright on a vibrating pivot: g/(l omega^2) = -a_0(2 A/l)/4, a_0 the characteristic value
///                      of Mathieu's equation, to 12 published digits
///   chain of N:        omega^2 = (g/l) x, x the zeros of the Laguerre polynomial L_N
///
/// And steady motions with parts that spin or roll, see steady_motions.h.
[[nodiscard]] std::vector<Compared> small_motions();

/// The same system by system.
struct SmallMotions {
  std::string name;
  std::function<std::vector<Compared>()> rows;
};
[[nodiscard]] std::vector<SmallMotions> systems_with_small_motions();

/// The zeros of the Laguerre polynomial of degree N, increasing, from sign changes of its recurrence: for N
/// to a few dozen.
[[nodiscard]] std::vector<double> laguerre_zeros(int N);

}  // namespace dalembert::models
