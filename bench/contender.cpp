#include "dalembert/bench/contender.h"

#include <dalembert/bench/peers/peers.h>

#include <algorithm>

namespace dalembert::bench {

const char* name(Contender contender) {
  switch (contender) {
    case Contender::ida:
      return name(Stepper::ida);
    case Contender::erk:
      return name(Stepper::erk);
    case Contender::hand:
      return "hand";
    case Contender::simbody_pin:
      return "simbody-pin";
    case Contender::simbody_rod:
      return "simbody-rod";
  }
  return "";
}

std::vector<Contender> contenders() {
  std::vector<Contender> all{Contender::ida, Contender::erk, Contender::hand};
  for (const Contender peer : peers()) all.push_back(peer);
  return all;
}

std::optional<Stepper> stepper(Contender contender) {
  switch (contender) {
    case Contender::ida:
      return Stepper::ida;
    case Contender::erk:
      return Stepper::erk;
    default:
      return {};
  }
}

std::string remark(std::span<const Contender> contenders) {
  const bool simbody = std::any_of(contenders.begin(), contenders.end(), [](Contender c) {
    return c == Contender::simbody_pin || c == Contender::simbody_rod;
  });
  return simbody ? ". Debian's Simbody is built with assertions on: its times are upper bounds" : "";
}

}  // namespace dalembert::bench
