#pragma once

#include <dalembert/core/errors.h>
#include <dalembert/solvers/certificate/largest_errors.h>
#include <dalembert/solvers/certificate/two_runs.h>
#include <dalembert/solvers/simulation.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace dalembert {

/// A run with the errors of all that it gives.
///
///   const auto certificate = certify(scene, {.t_end = 10.0, .tolerance = 1e-8});
///   const auto& run = certificate.run();
///   std::cout << -run.multiplier(rod, i) << " +- " << certificate.multiplier_error(rod, i) << " N\n";
///
/// `run()` is to the last bit what `simulate` gives with these options; its errors are estimated, not
/// bounded: by the difference from `reference()`, a run at a hundredth of the tolerance, see TwoRuns. In the
/// benchmark (`dalembert-bench certificates`) estimates of positions and forces are within a quarter of the
/// true errors in more than 95 of 100 runs. The other choice would be to hand out the better run with these
/// errors as its bounds: a hundred times too large, and nobody would know how true they are. Who wants the
/// better numbers reads `reference()`, whose errors these bound.
///
/// An error is the norm of the vector that is off. It is never less than what round-off makes of the
/// quantity; and it is infinite where nothing is known: `doubt` says why, as does `statement`.
template <int D>
class Certificate {
 public:
  /// Made by `certify`.
  explicit Certificate(TwoRuns runs);
  // These are compiled once, in the library.
  ~Certificate();
  Certificate(const Certificate& other);  ///< shares the numbers of its runs, also of one that is moved
  Certificate& operator=(const Certificate& other);  ///< shares the numbers of its runs

  /// To the last bit the run of `simulate`.
  [[nodiscard]] const Trajectory<D>& run() const& { return run_; }
  /// The more accurate one; it may have more samples, where events end it.
  [[nodiscard]] const Trajectory<D>& reference() const& { return reference_; }
  void run() const&& = delete;  // keep the certificate
  void reference() const&& = delete;

  /// The error of whatever `quantity(const Sample<D>&)` gives, a number or vector, at sample i. Infinite also
  /// where either run leaves a force undetermined.
  template <class Quantity>
  [[nodiscard]] double error(const Quantity& quantity, std::size_t i) const {
    return compare(quantity, run_.sample(i), reference_, &Trajectory<D>::sample, runs_.sample(i));
  }
  /// The same at the k-th thing that happened: before it, and after.
  template <class Quantity>
  [[nodiscard]] double event_error(const Quantity& quantity, std::size_t k) const {
    return compare(quantity, run_.event_sample(k), reference_, &Trajectory<D>::event_sample, runs_.event(k));
  }
  /// Of the state after it.
  template <class Quantity>
  [[nodiscard]] double error_after(const Quantity& quantity, std::size_t k) const {
    return compare(quantity, run_.sample_after(k), reference_, &Trajectory<D>::sample_after, runs_.event(k));
  }

  /// Of the readings of the same names, see Sample, at sample i.
  template <Point P>
  [[nodiscard]] double position_error(const P& point, std::size_t i) const {
    return error_of_position([&](const Sample<D>& now) { return now.position(point); }, runs_.length(), i);
  }
  /// Of the velocity of a point [speed].
  template <Point P>
  [[nodiscard]] double velocity_error(const P& point, std::size_t i) const {
    return error_of_velocity([&](const Sample<D>& now) { return now.velocity(point); }, runs_.speed(), i);
  }
  /// Of the angle of a rotor [rad].
  [[nodiscard]] double angle_error(Rotor rotor, std::size_t i) const {
    return error_of_position([&](const Sample<D>& now) { return now.angle(rotor); }, 1.0, i);
  }
  /// Of its rate [rad / time].
  [[nodiscard]] double angular_velocity_error(Rotor rotor, std::size_t i) const {
    return error_of_velocity([&](const Sample<D>& now) { return now.angular_velocity(rotor); },
                             runs_.speed() / runs_.length(), i);
  }
  /// Of a multiplier, of several the norm [force].
  template <int Rows>
  [[nodiscard]] double multiplier_error(Constraint<Rows> constraint, std::size_t i) const {
    return larger(error([&](const Sample<D>& now) { return now.multiplier(constraint); }, i),
                  runs_.error_of_force(0.0, at(i)));
  }
  /// On a particle or a body.
  template <int Rows, class Body>
  [[nodiscard]] double constraint_force_error(Constraint<Rows> constraint, const Body& body,
                                              std::size_t i) const {
    return error([&](const Sample<D>& now) { return now.constraint_force(constraint, body); }, i);
  }
  /// Of the time of the k-th thing that happened, and of an impulse there.
  [[nodiscard]] double event_time_error(std::size_t k) const {
    (void)run_.event_sample(k);  // is there one?
    return runs_.error_of_time(k);
  }
  /// Of the impulse of a constraint at the k-th thing that happened [force time].
  template <int Rows>
  [[nodiscard]] double impulse_error(Constraint<Rows> constraint, std::size_t k) const {
    const auto own = run_.impulse(constraint, k);
    const Certainty& its = runs_.event(k);
    if (its.doubt != Doubt::none) return std::numeric_limits<double>::infinity();
    return runs_.error(size(own - reference_.impulse(constraint, its.counterpart)), size(own), its);
  }

  /// What of an error at sample i is no error but round-off: a fifth of it would not be told from 0.
  template <class Quantity>
  [[nodiscard]] double round_off(const Quantity& quantity, std::size_t i) const {
    const Certainty& its = at(i);
    if (its.doubt != Doubt::none) return std::numeric_limits<double>::infinity();
    const auto a = quantity(run_.sample(i));
    return runs_.round_off(size(a - quantity(reference_.sample(its.counterpart))), size(a), its);
  }

  /// Why an error at sample i is not known.
  [[nodiscard]] Doubt doubt(std::size_t i) const { return at(i).doubt; }
  /// Why an error at the k-th thing that happened is not known.
  [[nodiscard]] Doubt event_doubt(std::size_t k) const {
    (void)run_.event_sample(k);
    return runs_.event(k).doubt;
  }
  /// Whether all errors are known, but those of velocities and forces beside a jump and of forces that are
  /// not determined.
  [[nodiscard]] bool complete() const { return runs_.complete(); }
  /// The largest errors, where they are known.
  [[nodiscard]] LargestErrors largest() const { return largest_errors(runs_); }

  /// All of it in words.
  [[nodiscard]] std::string statement() const;
  /// Both runs, without dimension.
  [[nodiscard]] const TwoRuns& runs() const& { return runs_; }

 private:
  [[nodiscard]] static double size(double x) { return std::abs(x); }
  template <class Vector>
  [[nodiscard]] static double size(const Vector& x) requires(!std::is_arithmetic_v<Vector>) {
    return x.norm();
  }
  [[nodiscard]] const Certainty& at(std::size_t i) const {
    (void)run_.sample(i);  // is there one?
    return runs_.sample(i);
  }
  template <class Quantity>
  [[nodiscard]] double error_of_position(const Quantity& quantity, double unit, std::size_t i) const {
    return error_of_state(quantity, unit, i, at(i).of_positions());
  }
  template <class Quantity>
  [[nodiscard]] double error_of_velocity(const Quantity& quantity, double unit, std::size_t i) const {
    return error_of_state(quantity, unit, i, at(i).of_velocities());
  }
  template <class Quantity>
  [[nodiscard]] double error_of_state(const Quantity& quantity, double unit, std::size_t i,
                                      const Certainty& its) const {
    return larger(compare(quantity, run_.sample(i), reference_, &Trajectory<D>::sample, its),
                  its.of_states * unit);
  }
  template <class Quantity>
  [[nodiscard]] double compare(const Quantity& quantity, const Sample<D>& own, const Trajectory<D>& reference,
                               Sample<D> (Trajectory<D>::*read)(std::size_t) const&,
                               const Certainty& its) const try {
    if (its.doubt != Doubt::none) return std::numeric_limits<double>::infinity();
    const auto a = quantity(own);
    const double own_error =
        runs_.error(size(a - quantity((reference.*read)(its.counterpart))), size(a), its);
    if (!runs_.vibrates()) return own_error;
    const auto moved = runs_.moved(own.flat());
    const double by = size(quantity(Sample<D>(own.layout(), moved.flat)) - a);
    return by >= 0.0 ? larger(own_error, by) : std::numeric_limits<double>::infinity();
  } catch (const UndeterminedForce&) {
    return std::numeric_limits<double>::infinity();
  }

  TwoRuns runs_;
  Trajectory<D> run_, reference_;
};

extern template class Certificate<2>;
extern template class Certificate<3>;

/// Runs a scene as the options say, and once more at a hundredth of the tolerance; with events, too.
/// Equations are called on two threads at once: what they change must be their own. An audit that the options
/// turn off is made all the same. Throws what `simulate` throws.
template <int D>
[[nodiscard]] Certificate<D> certify(const Scene<D>& scene, const Options& options,
                                     const std::vector<Event<D>>& events = {});

extern template Certificate<2> certify(const Scene<2>&, const Options&, const std::vector<Event<2>>&);
extern template Certificate<3> certify(const Scene<3>&, const Options&, const std::vector<Event<3>>&);

}  // namespace dalembert
