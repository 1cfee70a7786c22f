#include "dalembert/solvers/linear/kkt.h"

#include <limits>
#include <numeric>

namespace dalembert {

namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

std::vector<std::size_t> all_coordinates(const System& system) {
  std::vector<std::size_t> all(system.coordinates());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

}  // namespace

/// Entries in the order in which `assemble` adds: masses, then for each row the entries of -W^T and L
/// and, if it is compliant, s; then dF/dlambda and the linearised forces.
struct KktMatrix::Plan {
  std::vector<std::size_t> coordinates;
  std::vector<std::size_t> friction, stiffness, damping;
  std::vector<SparseLU::Entry> entries;
  std::size_t first_force_entry;
};

KktMatrix::Plan KktMatrix::plan(const System& system, const ActiveRows& rows, Forces forces,
                                std::vector<std::size_t> coordinates) {
  Plan plan{std::move(coordinates), {}, {}, {}, {}, 0};
  std::vector<std::size_t> place(system.coordinates(), none);
  std::size_t next = 0;
  for (const std::size_t i : plan.coordinates) {
    place[i] = next;
    plan.entries.push_back({next, next});
    ++next;
  }
  std::vector<std::size_t> place_of_row(system.rows(), none);
  for (const std::size_t r : rows.rows) {
    place_of_row[r] = next;
    for (const std::size_t k : system.row(r)) {
      const std::size_t own = place[system.w_columns()[k]];
      plan.entries.push_back({own, next});
      plan.entries.push_back({next, own});
    }
    if (system.compliance()[r] > 0.0) plan.entries.push_back({next, next});
    ++next;
  }
  plan.first_force_entry = plan.entries.size();
  if (forces == Forces::none) return plan;
  for (std::size_t k = 0; k < system.friction_pattern().size(); ++k) {
    const auto [coordinate, row] = system.friction_pattern()[k];
    const std::size_t own = place[coordinate], column = place_of_row[row];
    if (own == none || column == none) continue;
    plan.entries.push_back({own, column});
    plan.friction.push_back(k);
  }
  if (forces == Forces::friction) return plan;
  const auto add = [&](std::span<const System::Entry> pattern, std::vector<std::size_t>& used) {
    for (std::size_t k = 0; k < pattern.size(); ++k) {
      const std::size_t row = place[pattern[k].row];
      if (row == none) continue;
      plan.entries.push_back({row, place[pattern[k].column]});
      used.push_back(k);
    }
  };
  add(system.stiffness_pattern(), plan.stiffness);
  add(system.damping_pattern(), plan.damping);
  return plan;
}

KktMatrix::KktMatrix(const System& system, const ActiveRows& rows, Forces forces)
    : KktMatrix(system, rows, forces, all_coordinates(system)) {}

KktMatrix::KktMatrix(const System& system, const ActiveRows& rows, Forces forces,
                     std::vector<std::size_t> coordinates)
    : KktMatrix(system, rows, plan(system, rows, forces, std::move(coordinates))) {}

KktMatrix::KktMatrix(const System& system, const ActiveRows& rows, Plan plan)
    : system_(&system),
      rows_(rows.rows),
      coordinates_(std::move(plan.coordinates)),
      friction_(std::move(plan.friction)),
      stiffness_(std::move(plan.stiffness)),
      damping_(std::move(plan.damping)),
      lu_(coordinates_.size() + rows_.size(), plan.entries),
      first_force_entry_(plan.first_force_entry) {}

void KktMatrix::assemble(std::span<const double> w, std::span<const double> lower,
                         std::span<const double> s) {
  lu_.set_zero();
  std::size_t entry = 0;
  for (const std::size_t i : coordinates_) lu_.add(entry++, system_->masses()[i]);
  for (const std::size_t r : rows_) {
    for (const std::size_t k : system_->row(r)) {
      lu_.add(entry++, -w[k]);
      lu_.add(entry++, lower[k]);
    }
    if (system_->compliance()[r] > 0.0) lu_.add(entry++, s.empty() ? 0.0 : s[r]);
  }
}

bool KktMatrix::factorise(std::span<const double> w, std::span<const double> s) {
  assemble(w, w, s);
  return lu_.factorise();
}

void KktMatrix::add_friction(std::span<const double> friction) {
  std::size_t entry = first_force_entry_;
  for (const std::size_t k : friction_) lu_.add(entry++, -friction[k]);
}

bool KktMatrix::factorise_with_friction(std::span<const double> w, std::span<const double> s,
                                        std::span<const double> friction) {
  assemble(w, w, s);
  add_friction(friction);
  return lu_.factorise();
}

bool KktMatrix::factorise(std::span<const double> w, std::span<const double> lower,
                          const System::Linearisation& forces, double h, double d,
                          std::span<const double> s) {
  assemble(w, lower, s);
  add_friction(forces.friction);
  std::size_t entry = first_force_entry_ + friction_.size();
  for (const std::size_t k : stiffness_) lu_.add(entry++, -h * forces.stiffness[k]);
  for (const std::size_t k : damping_) lu_.add(entry++, -d * forces.damping[k]);
  return lu_.factorise();
}

}  // namespace dalembert
