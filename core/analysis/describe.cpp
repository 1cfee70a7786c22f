#include "dalembert/core/scene/system.h"
#include <dalembert/core/analysis/integrability.h>
#include <dalembert/core/analysis/islands.h>
#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/analysis/second_order.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace dalembert {

namespace {

std::string kinds(const auto& batches) {
  std::map<std::string, std::size_t> count;
  for (const auto& batch : batches) count[std::string(batch->shape().kind)] += batch->size();
  std::string text;
  for (const auto& [kind, number] : count) {
    text += (text.empty() ? "" : ", ") + std::to_string(number) + ' ' + kind;
  }
  return text.empty() ? "none" : text;
}

std::string rotors(std::size_t count) {
  return count == 0 ? "" : " and " + std::to_string(count) + (count == 1 ? " rotor" : " rotors");
}

/// By count: where there are more equations than coordinates some depend on others.
std::string freedom(std::size_t coordinates, std::size_t equations) {
  if (equations <= coordinates) return std::to_string(coordinates - equations);
  return "undetermined (" + std::to_string(equations - coordinates) + " equations more than coordinates)";
}

std::string freedom_by_count(const System& system) {
  const std::size_t n = system.coordinates(), compliant = system.compliant_rows();
  return "degrees of freedom: " + freedom(n, system.holonomic_rows() - compliant) + " of position, " +
         freedom(n, system.rows() - compliant) + " of velocity (if the constraints are independent)\n";
}

/// By rank: rows that yield remove none.
std::string freedom_by_rank(const System& system, double t, std::span<const double> q) {
  const std::vector<double> at_rest(q.size(), 0.0);
  auto e = system.evaluation();
  system.evaluate({t, q, at_rest}, e);
  const ActiveRows independent = independent_rows(system, e.w);
  const std::size_t n = system.coordinates(), compliant = system.compliant_rows();
  const std::size_t held = held_to_second_order(system, t, q, independent);
  std::ostringstream out;
  out << "at t = " << t << ": " << independent.size() - compliant << " of " << system.rows() - compliant
      << " constraint equations independent, " << n + compliant - independent.size()
      << " degrees of freedom of velocity, " << n + compliant - independent.holonomic - held
      << " of position\n";
  if (held > 0)
    out << "  singular position: " << held
        << " of these velocities are free to first order only, the constraints hold them to second order\n";
  return out.str();
}

/// Labels of rows, one after the other: each constraint once, with how many of its equations these are.
std::string listed(const std::vector<std::string>& labels) {
  std::string text;
  for (auto label = labels.begin(); label != labels.end();) {
    const auto next = std::find_if(label, labels.end(), [&](const auto& other) { return other != *label; });
    text += (text.empty() ? "" : ", ") + *label;
    if (next - label > 1) text += " (" + std::to_string(next - label) + " equations)";
    label = next;
  }
  return text;
}

}  // namespace

std::string System::describe() const {
  const std::size_t n = coordinates();
  const std::size_t nonholonomic = rows() - holonomic_rows();
  std::ostringstream out;
  out << "scene \"" << layout()->scene << "\": " << layout()->particles.size()
      << (layout()->particles.size() == 1 ? " particle" : " particles") << rotors(layout()->rotors.size())
      << " in " << layout()->dimension << " dimensions, " << n << " coordinates\n"
      << "constraints: " << kinds(batches()) << "; " << holonomic_rows() << " holonomic and " << nonholonomic
      << " nonholonomic equations, " << (rheonomic() ? "rheonomic" : "scleronomic") << '\n'
      << (conditions().contacts().empty()
              ? ""
              : "one-sided of these: " + std::to_string(conditions().contacts().size()) +
                    ", counted as closed\n")
      << freedom_by_count(*this) << "islands that do not act on each other: " << islands(*this).count << '\n'
      << "forces: " << kinds(forces().plain()) << " besides constant ones"
      << (forces().has_friction() ? ", and " + kinds(forces().friction()) + " that read multipliers" : "")
      << '\n'
      << "unknowns of the stabilised index-2 equations: " << 2 * n + rows() + holonomic_rows() << '\n';
  const auto left_out = [&out](bool is, const char* what) {
    if (is) out << "left out: " << what << '\n';
  };
  left_out(layout()->dimension == 2, "the third coordinate: the scene is planar");
  left_out(rows() > 0 && !rheonomic(), "time derivatives of the constraints: none depends on time");
  left_out(rows() > 0 && !compliant(), "compliance: all constraints are rigid");
  left_out(stiffness_pattern().empty(), "the stiffness block: no force or constraint varies with position");
  left_out(forces().damping_pattern().empty(), "the damping block: no force depends on velocities");
  left_out(!forces().has_friction() && rows() > 0, "friction: no force reads a multiplier");
  left_out(holonomic_rows() == 0, "the position multipliers mu: there is no holonomic constraint");
  left_out(rows() == 0, "the constraint forces: there is no constraint");
  return out.str();
}

std::string System::describe(double t, std::span<const double> q) const {
  std::string whole = describe();
  const std::string by_count = freedom_by_count(*this);  // says less than the rank, or what is not so
  whole.replace(whole.find(by_count), by_count.size(), freedom_by_rank(*this, t, q));
  std::ostringstream out;
  out << whole;
  for (const Integrability& set : integrability(*this, t, q)) {
    out << listed(set.constraints) << ": " << (set.holonomic ? "integrable" : "not integrable") << '\n';
    if (set.integrable_alone.empty()) continue;
    out << "  but by itself is integrable: " << listed(set.integrable_alone) << '\n';
  }
  return out.str();
}

}  // namespace dalembert
