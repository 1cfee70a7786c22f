#pragma once

#include <dalembert/solvers/certificate/certificate.h>
#include <dalembert/solvers/lagrange/lagrangian_simulation.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

namespace dalembert {

/// The motion of a Lagrangian system with the errors of its coordinates, rates and multipliers; what holds of
/// a Certificate holds of it. `run()` is what `simulate` gives.
template <int N>
class LagrangianCertificate {
 public:
  /// Of a run of `system.rotor_scene(t_start)`.
  LagrangianCertificate(const LagrangianSystem<N>& system, Certificate<2> rotors)
      : rotors_(std::move(rotors)),
        run_(system, rotors_.run(), rotors_.run().record()->tolerance),
        reference_(system, rotors_.reference(), rotors_.reference().record()->tolerance) {}

  /// The motion that was asked for.
  [[nodiscard]] const LagrangianMotion<N>& run() const& { return run_; }
  /// The more accurate one.
  [[nodiscard]] const LagrangianMotion<N>& reference() const& { return reference_; }
  void run() const&& = delete;  // keep the certificate
  void reference() const&& = delete;

  /// The error of each coordinate at sample i.
  [[nodiscard]] Vec<N> position_error(std::size_t i) const {
    return of_each([&](Rotor rotor) { return rotors_.angle_error(rotor, i); });
  }
  /// The error of each rate.
  [[nodiscard]] Vec<N> velocity_error(std::size_t i) const {
    return of_each([&](Rotor rotor) { return rotors_.angular_velocity_error(rotor, i); });
  }
  /// The error of whatever `quantity(const LagrangianMotion<N>&, std::size_t i)` gives, a number or a vector,
  /// at sample i. Infinite where nothing is known (see `doubt`), and where either run leaves a force
  /// undetermined.
  template <class Quantity>
  [[nodiscard]] double error(const Quantity& quantity, std::size_t i) const try {
    (void)run_.position(i);  // is there one?
    const Certainty& its = rotors_.runs().sample(i);
    if (its.doubt != Doubt::none) return std::numeric_limits<double>::infinity();
    const auto own = quantity(run_, i);
    return rotors_.runs().error(size(own - quantity(reference_, its.counterpart)), size(own), its);
  } catch (const UndeterminedForce&) {
    return std::numeric_limits<double>::infinity();
  }
  /// The error of a multiplier, or the norm of that of several.
  template <int Rows>
  [[nodiscard]] double multiplier_error(Constraint<Rows> constraint, std::size_t i) const {
    return error([&](const auto& motion, std::size_t k) { return motion.multiplier(constraint, k); }, i);
  }

  /// Why an error at sample i is not known.
  [[nodiscard]] Doubt doubt(std::size_t i) const { return rotors_.doubt(i); }
  /// Whether all errors are known.
  [[nodiscard]] bool complete() const { return rotors_.complete(); }
  /// All of it in words; a coordinate is told in units of its scale.
  [[nodiscard]] std::string statement() const { return rotors_.statement(); }

 private:
  template <class Error>
  [[nodiscard]] Vec<N> of_each(const Error& error) const {
    const LagrangianSystem<N>& system = run_.system();
    Vec<N> x;
    for (int k = 0; k < N; ++k)
      x[k] = system.scale()[k] * error(system.rotors()[static_cast<std::size_t>(k)]);
    return x;
  }
  [[nodiscard]] static double size(double x) { return std::abs(x); }
  template <class Vector>
  [[nodiscard]] static double size(const Vector& x) requires(!std::is_arithmetic_v<Vector>) {
    return x.norm();
  }

  Certificate<2> rotors_;
  LagrangianMotion<N> run_, reference_;
};

/// Runs a Lagrangian system as the options say, and once more at a hundredth of the tolerance; see the
/// `certify` of a scene. Throws what `simulate` throws.
template <int N>
[[nodiscard]] LagrangianCertificate<N> certify(const LagrangianSystem<N>& system, const Options& options) {
  return {system, certify(system.rotor_scene(options.t_start), options)};
}

}  // namespace dalembert
