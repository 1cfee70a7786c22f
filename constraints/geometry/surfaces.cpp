#include "dalembert/constraints/geometry/surfaces.h"

#include <cmath>

namespace dalembert::detail {

Vec<3> unit_vector(const Vec<3>& v) { return v.normalized(); }

template <int D>
std::string direction_fault(const Vec<D>& direction, const char* name) {
  if (direction.allFinite() && direction.norm() > 0.0) return {};
  return std::string(name) + " must be finite and not zero";
}
template <int D>
std::string place_fault(const Vec<D>& place, const char* name) {
  if (place.allFinite()) return {};
  return std::string(name) + " must be finite";
}
std::string positive_fault(double value, const char* name) {
  if (std::isfinite(value) && value > 0.0) return {};
  return std::string(name) + " = " + text(value) + ", must be finite and > 0";
}

std::string first_fault(std::initializer_list<std::string> faults) {
  for (const std::string& fault : faults) {
    if (!fault.empty()) return fault;
  }
  return {};
}

template std::string direction_fault(const Vec<2>&, const char*);
template std::string direction_fault(const Vec<3>&, const char*);
template std::string place_fault(const Vec<2>&, const char*);
template std::string place_fault(const Vec<3>&, const char*);

}  // namespace dalembert::detail
