#include "dalembert/core/equations/contact.h"

namespace dalembert {

namespace {

std::vector<std::size_t> constraints_that(const Conditions& conditions, const auto& hold) {
  std::vector<std::size_t> numbers;
  for (std::size_t c = 0; c < conditions.of.size(); ++c)
    if (hold(conditions.of[c])) numbers.push_back(c);
  return numbers;
}

}  // namespace

std::vector<std::size_t> Conditions::contacts() const {
  return constraints_that(*this, [](const Condition& c) { return c.contact.has_value(); });
}

std::vector<std::size_t> Conditions::frictional_constraints() const {
  return constraints_that(*this, [](const Condition& c) { return c.roughness.has_value(); });
}

std::vector<std::size_t> Conditions::conditional_constraints() const {
  return constraints_that(*this, [](const Condition& c) { return c.contact || c.roughness; });
}

std::vector<std::size_t> Conditions::released() const {
  return constraints_that(*this, [](const Condition& c) { return c.released; });
}

}  // namespace dalembert
