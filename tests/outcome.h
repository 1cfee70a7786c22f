#pragma once

#include <dalembert/core/results/trajectory.h>

#include <cxxabi.h>

#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <typeinfo>

namespace dalembert {

/// What became of a run, as tables show it: "ok", or the type of the error that refused or stopped it.
/// A refusal may be what is due: it is a result like any other.
struct Outcome {
  std::string name = "ok";
  std::string message{};  ///< of the error

  [[nodiscard]] bool ok() const { return name == "ok"; }
};

/// The outcome that an error is: its type, without namespaces, and what it says.
[[nodiscard]] inline Outcome outcome_of(const std::exception& error) {
  const char* mangled = typeid(error).name();
  int status = 0;
  const std::unique_ptr<char, decltype(&std::free)> plain(
      abi::__cxa_demangle(mangled, nullptr, nullptr, &status), std::free);
  const std::string name = status == 0 ? plain.get() : mangled;
  const std::size_t scope = name.rfind("::");
  return {scope == std::string::npos ? name : name.substr(scope + 2), error.what()};
}

/// Of what was computed before the error.
[[nodiscard]] inline Statistics statistics_of(const std::exception& error) {
  const auto* failure = dynamic_cast<const IntegrationFailure*>(&error);
  return failure != nullptr ? failure->record()->statistics : Statistics{};
}

}  // namespace dalembert
