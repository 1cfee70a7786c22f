#pragma once

#include <dalembert/models/model.h>
#include <dalembert/solvers/base/options.h>

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dalembert::bench {

/// Who integrates: the library's steppers, an equation of motion derived by hand, and peers where
/// they were found when this was built. The tables name them in the column "stepper".
enum class Method {
  ida,
  erk,
  hand,         ///< double precision, Runge-Kutta-Fehlberg 7(8) of Boost.odeint
  simbody_pin,  ///< Simbody, minimal coordinates
  simbody_rod   ///< Simbody, Cartesian coordinates and rods
};
[[nodiscard]] const char* name(Method method);

/// Those that this build has.
[[nodiscard]] std::vector<Method> all_methods();

/// The library's own stepper of that name, if it is one.
[[nodiscard]] std::optional<Stepper> stepper(Method method);

/// What a reader of these methods' figures must know, as a sentence to append; mostly nothing.
[[nodiscard]] std::string remark(std::span<const Method> methods);

/// What a method's run gave: the model's observations at the times asked for, and what they cost.
template <int D>
struct MethodRun {
  std::vector<models::Observation<D>> seen;
  Statistics statistics;
};

/// What integrates one system from times.front() to times.back() without the library. The tolerance is each
/// method's own: only errors and run times compare.
template <int D>
using Methods =
    std::map<Method, std::function<MethodRun<D>(std::span<const double> times, double tolerance)>>;

/// A method's run could not be finished.
struct MethodFailure : Error {
  using Error::Error;
};

/// One of them, run as the options say. Throws MethodFailure for whatever its library throws.
template <int D>
[[nodiscard]] MethodRun<D> run(const Methods<D>& methods, Method method, const Options& options) try {
  return methods.at(method)(sample_times(options), options.tolerance);
} catch (const std::exception& error) {
  throw MethodFailure(error.what());
}

}  // namespace dalembert::bench
