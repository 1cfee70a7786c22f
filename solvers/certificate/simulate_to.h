#pragma once

#include <dalembert/solvers/certificate/certificate.h>

#include <string>
#include <vector>

namespace dalembert {

/// What errors a run may have: `simulate_to(scene, {.t_end = 10.0, .force_error = 1e-6})`. At least one of
/// them is > 0; what is 0 is not asked for.
struct Request {
  double t_end = 0.0;           ///< as in Options, as are the next three
  double t_start = 0.0;         ///< time of the initial state [time]
  int samples = 101;            ///< number of samples, equally spaced
  std::vector<double> times{};  ///< or these times

  double force_error = 0.0;     ///< of every multiplier at every sample [force]
  double position_error = 0.0;  ///< of every particle at every sample [length]
  double event_error = 0.0;     ///< of the time of everything that happens [time]
  /// Then the first is a part of the largest multiplier, the second of the scene's length, the third of the
  /// length of the run.
  bool relative = false;

  /// All else; its times, samples, tolerance and stepper do not count.
  Options options{};
};

/// What came of it.
struct RequestOutcome {
  bool met = false;             ///< whether the certificate meets the request
  int runs = 0;                 ///< of the scene, in all
  double processor_time = 0.0;  ///< of all of them, without set-up [s]
  std::string words{};          ///< whether it is met; if not what was reached, and why no more
};

template <int D>
struct SimulatedTo {
  Certificate<D> certificate;  ///< of the run that meets the request, or else the best one, see below
  RequestOutcome outcome;

  [[nodiscard]] const Trajectory<D>& run() const& { return certificate.run(); }
  void run() const&& = delete;
};

/// Chooses the stepper and the tolerance so that the certificate of a run meets the request: explicit unless
/// the scene is stiff, first a tolerance as errors usually are, then one by the errors that were found. Each
/// is certified by a run at a thirtieth of its tolerance; a more accurate run serves as long as it is. The
/// best run is the one that errs least; where none is known to the end, as in chaos, the one that is known
/// longest. Throws InvalidArgument for a request that makes no sense, else what `simulate` throws.
template <int D>
[[nodiscard]] SimulatedTo<D> simulate_to(const Scene<D>& scene, const Request& request,
                                         const std::vector<Event<D>>& events = {});

extern template SimulatedTo<2> simulate_to(const Scene<2>&, const Request&, const std::vector<Event<2>>&);
extern template SimulatedTo<3> simulate_to(const Scene<3>&, const Request&, const std::vector<Event<3>>&);

}  // namespace dalembert
