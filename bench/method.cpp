#include "dalembert/bench/method.h"

#include <dalembert/bench/peers/peers.h>

#include <algorithm>

namespace dalembert::bench {

const char* name(Method method) {
  switch (method) {
    case Method::ida:
      return name(Stepper::ida);
    case Method::erk:
      return name(Stepper::erk);
    case Method::hand:
      return "hand";
    case Method::simbody_pin:
      return "simbody-pin";
    case Method::simbody_rod:
      return "simbody-rod";
  }
  return "";
}

std::vector<Method> all_methods() {
  std::vector<Method> all{Method::ida, Method::erk, Method::hand};
  for (const Method peer : peers()) all.push_back(peer);
  return all;
}

std::optional<Stepper> stepper(Method method) {
  switch (method) {
    case Method::ida:
      return Stepper::ida;
    case Method::erk:
      return Stepper::erk;
    default:
      return {};
  }
}

std::string remark(std::span<const Method> methods) {
  const bool simbody = std::ranges::any_of(
      methods, [](Method m) { return m == Method::simbody_pin || m == Method::simbody_rod; });
  return simbody ? ". Debian's Simbody is built with assertions on: its times are upper bounds" : "";
}

}  // namespace dalembert::bench
