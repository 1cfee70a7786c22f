#include "dalembert/solvers/private/kkt.h"

namespace dalembert {

namespace {

/// In the order in which `assemble` adds: masses, then for each row the entries of -W^T and L, then
/// the linearised forces.
std::vector<SparseLU::Entry> entries(const System& system, const ActiveRows& active,
                                     KktMatrix::Forces forces) {
  std::vector<SparseLU::Entry> list;
  const int n = system.coordinates();
  for (int i = 0; i < n; ++i) list.push_back({i, i});
  int multiplier = n;
  for (const int row : active.rows) {
    const auto r = static_cast<std::size_t>(row);
    for (int k = system.row_start()[r]; k < system.row_start()[r + 1]; ++k) {
      const int coordinate = system.w_columns()[static_cast<std::size_t>(k)];
      list.push_back({coordinate, multiplier});
      list.push_back({multiplier, coordinate});
    }
    ++multiplier;
  }
  if (forces == KktMatrix::Forces::linearised) {
    for (const auto& entry : system.stiffness_pattern()) list.push_back({entry.row, entry.column});
    for (const auto& entry : system.damping_pattern()) list.push_back({entry.row, entry.column});
  }
  return list;
}

std::size_t entries_before_forces(const System& system, const ActiveRows& active) {
  auto count = static_cast<std::size_t>(system.coordinates());
  for (const int row : active.rows) {
    const auto r = static_cast<std::size_t>(row);
    count += 2 * static_cast<std::size_t>(system.row_start()[r + 1] - system.row_start()[r]);
  }
  return count;
}

}  // namespace

KktMatrix::KktMatrix(const System& system, const ActiveRows& rows, Forces forces)
    : system_(&system),
      rows_(rows.rows),
      lu_(system.coordinates() + rows.size(), entries(system, rows, forces)),
      first_force_entry_(entries_before_forces(system, rows)) {}

void KktMatrix::assemble(std::span<const double> w, std::span<const double> lower) {
  lu_.set_zero();
  std::size_t entry = 0;
  for (const double m : system_->masses()) lu_.add(entry++, m);
  for (const int row : rows_) {
    const auto r = static_cast<std::size_t>(row);
    for (auto k = system_->row_start()[r]; k < system_->row_start()[r + 1]; ++k) {
      lu_.add(entry++, -w[static_cast<std::size_t>(k)]);
      lu_.add(entry++, lower[static_cast<std::size_t>(k)]);
    }
  }
}

bool KktMatrix::factorise(std::span<const double> w) {
  assemble(w, w);
  return lu_.factorise();
}

bool KktMatrix::factorise(std::span<const double> w, std::span<const double> lower,
                          const System::Linearisation& forces, double h, double d) {
  assemble(w, lower);
  std::size_t entry = first_force_entry_;
  for (const double k : forces.stiffness) lu_.add(entry++, -h * k);
  for (const double c : forces.damping) lu_.add(entry++, -d * c);
  return lu_.factorise();
}

}  // namespace dalembert
