#include "dalembert/solvers/certificate/statement.h"

#include <sstream>
#include <vector>

namespace dalembert {

namespace {

std::string error_in(const char* what, const LargestError& most) {
  if (most.of.empty()) return {};
  std::ostringstream out;
  out.precision(2);
  out << most.error << " in " << what << " (" << most.of << ", t = ";
  out.precision(6);
  out << most.time << ')';
  return out.str();
}

std::string joined(const std::vector<std::string>& parts) {
  std::string all;
  for (const std::string& part : parts)
    if (!part.empty()) all += (all.empty() ? "" : ", ") + part;
  return all;
}

}  // namespace

std::string statement(const TwoRuns& runs, const LargestErrors& errors) {
  const Record &run = *runs.run(), &better = *runs.reference();
  std::ostringstream out;
  out << "Scene \"" << run.layout->scene << "\" by " << run.stepper << " at tolerance " << run.tolerance
      << ", against " << better.stepper << " at " << better.tolerance << ": ";
  const std::string known =
      joined({error_in("position", errors.position), error_in("velocity", errors.velocity),
              error_in("angle", errors.angle), error_in("angular velocity", errors.angular_velocity),
              error_in("force of constraint", errors.force), error_in("impulse", errors.impulse),
              error_in("the time of an event", errors.event_time)});
  out << (known.empty() ? "no error is known" : "errors of at most " + known);
  if (!runs.reservation().empty()) {
    out << "; " << runs.reservation();
  } else if (errors.beyond > 0) {
    out << "; nothing is known at " << errors.beyond
        << " samples and events that the more accurate run does not have";
  }
  if (runs.vibrates())
    out << "; what vibrates faster than implicit steps follow counts with twice its amplitude: erk follows "
           "it";
  if (errors.beside_jumps > 0)
    out << "; what jumps is not known at " << errors.beside_jumps
        << " samples, as near to an impact or change as the time of that is known";
  if (errors.rests > 0)
    out << "; of " << errors.rests << " rests after infinitely many impacts only the time is known";
  if (errors.undetermined > 0)
    out << "; forces of constraint are not determined at " << errors.undetermined << " samples";
  out << '.';
  return out.str();
}

}  // namespace dalembert
