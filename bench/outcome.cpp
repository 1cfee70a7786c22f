#include "dalembert/bench/outcome.h"

#include <dalembert/bench/method.h>

#include <iostream>

namespace dalembert::bench {

Outcome refused_by(const Error& error) {
  const std::string said = error.what();
  if (dynamic_cast<const IntegrationFailure*>(&error) != nullptr) return {"IntegrationFailure", said};
  if (dynamic_cast<const InconsistentStart*>(&error) != nullptr) return {"InconsistentStart", said};
  if (dynamic_cast<const InvalidScene*>(&error) != nullptr) return {"InvalidScene", said};
  if (dynamic_cast<const InvalidArgument*>(&error) != nullptr) return {"InvalidArgument", said};
  if (dynamic_cast<const MethodFailure*>(&error) != nullptr) return {"MethodFailure", said};
  return {"Error", said};
}

Outcome outcome_of(const std::string& what, const std::function<void()>& run) try {
  run();
  return {};
} catch (const Error& error) {
  const Outcome refused = refused_by(error);
  tell(what, refused);
  return refused;
}

void tell(const std::string& what, const Outcome& outcome) {
  std::cerr << what << ": " << outcome.said << '\n';
}

}  // namespace dalembert::bench
