#include "dalembert/solvers/linear/whole.h"

#include <limits>

namespace dalembert {

namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

}  // namespace

/// Entries in the order in which `factorise` adds: masses, then for each row the entries of -W^T and L
/// and, if it is compliant, s; then dF_f/dlambda and the linearised forces.
struct WholePattern::Plan {
  std::vector<std::size_t> rows, coordinates;
  std::vector<std::size_t> slope{}, stiffness{}, damping{};
  std::vector<LuPattern::Entry> entries{};
};

WholePattern::Plan WholePattern::plan(const System& system, std::span<const std::size_t> rows,
                                      std::span<const std::size_t> coordinates, SaddleValues::Blocks blocks) {
  Plan plan{{rows.begin(), rows.end()}, {coordinates.begin(), coordinates.end()}};
  std::vector<std::size_t> place(system.coordinates(), none);
  std::size_t next = 0;
  for (const std::size_t i : coordinates) {
    place[i] = next;
    plan.entries.push_back({next, next});
    ++next;
  }
  std::vector<std::size_t> place_of_row(system.rows(), none);
  for (const std::size_t r : rows) {
    place_of_row[r] = next;
    for (const std::size_t k : system.row(r)) {
      const std::size_t own = place[system.w_columns()[k]];
      plan.entries.push_back({own, next});
      plan.entries.push_back({next, own});
    }
    if (system.law(r).compliant()) plan.entries.push_back({next, next});
    ++next;
  }
  if (blocks == SaddleValues::Blocks::symmetric) return plan;
  const auto add = [&](std::span<const MatrixEntry> pattern, const std::vector<std::size_t>& place_of_column,
                       std::vector<std::size_t>& used) {
    for (std::size_t k = 0; k < pattern.size(); ++k) {
      const std::size_t row = place[pattern[k].row], column = place_of_column[pattern[k].column];
      if (row == none || column == none) continue;
      plan.entries.push_back({row, column});
      used.push_back(k);
    }
  };
  add(system.forces().friction_pattern(), place_of_row, plan.slope);
  if (blocks == SaddleValues::Blocks::slope) return plan;
  add(system.stiffness_pattern(), place, plan.stiffness);
  add(system.forces().damping_pattern(), place, plan.damping);
  return plan;
}

WholePattern::WholePattern(const System& system, std::span<const std::size_t> rows,
                           std::span<const std::size_t> coordinates, SaddleValues::Blocks blocks)
    : WholePattern(system, plan(system, rows, coordinates, blocks)) {}

WholePattern::WholePattern(const System& system, Plan plan)
    : system_(&system),
      rows_(std::move(plan.rows)),
      coordinates_(std::move(plan.coordinates)),
      slope_(std::move(plan.slope)),
      stiffness_(std::move(plan.stiffness)),
      damping_(std::move(plan.damping)),
      lu_(coordinates_.size() + rows_.size(), plan.entries) {}

bool WholeMatrix::factorise(const SaddleValues& values) {
  const WholePattern& p = *pattern_;
  const System& system = *p.system_;
  const auto lower = values.lower.empty() ? values.w : values.lower;
  lu_.set_zero();
  std::size_t entry = 0;
  for (const std::size_t i : p.coordinates_) lu_.add(entry++, system.masses()[i]);
  for (const std::size_t r : p.rows_) {
    for (const std::size_t k : system.row(r)) {
      lu_.add(entry++, -values.w[k]);
      lu_.add(entry++, lower[k]);
    }
    if (system.law(r).compliant()) lu_.add(entry++, values.s.empty() ? 0.0 : values.s[r]);
  }
  for (const std::size_t k : p.slope_) lu_.add(entry++, -values.slope[k]);
  for (const std::size_t k : p.stiffness_) lu_.add(entry++, -values.h * values.forces->stiffness[k]);
  for (const std::size_t k : p.damping_) lu_.add(entry++, -values.d * values.forces->damping[k]);
  return lu_.factorise();
}

}  // namespace dalembert
