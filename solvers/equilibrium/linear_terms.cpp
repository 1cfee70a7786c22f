#include "dalembert/solvers/equilibrium/linear_terms.h"

namespace dalembert {

namespace {

void append(LinearTerms::Entries& to, std::size_t row, std::size_t column, double value) {
  to.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
}

/// -F_v A, from an entry of F_v.
void append_rotating(const RotatingFrame& frame, const System::Entry& place, double slope,
                     LinearTerms::Entries& K) {
  const std::size_t first = frame.first(place.column);
  if (first == RotatingFrame::none) return;
  for (std::size_t k = 0; k < frame.dimension(); ++k)
    append(K, place.row, first + k, -slope * frame.entry(place.column - first, k));
}

/// 2 M A and M A^2.
void append_inertia(const System& system, const RotatingFrame& frame, LinearTerms& terms) {
  for (std::size_t i = 0; i < system.coordinates(); ++i) {
    const std::size_t first = frame.first(i);
    if (first == RotatingFrame::none) continue;
    const double m = system.masses()[i];
    for (std::size_t k = 0; k < frame.dimension(); ++k) {
      append(terms.damping, i, first + k, 2.0 * m * frame.entry(i - first, k));
      append(terms.stiffness, i, first + k, m * frame.square_entry(i - first, k));
    }
  }
}

/// The first entry of a row in this column: a row with one coordinate of a particle has them all.
std::size_t place_in_row(const System& system, std::size_t row, std::size_t column) {
  std::size_t k = system.row(row).front();
  while (system.w_columns()[k] != column) ++k;
  return k;
}

/// E = psi_q + W A, with psi_q already in place.
void add_rotating(const System& system, const RotatingFrame& frame, LinearTerms& terms) {
  for (std::size_t r = system.holonomic_rows(); r < system.rows(); ++r) {
    for (const std::size_t k : system.row(r)) {
      const std::size_t i = system.w_columns()[k], first = frame.first(i);
      if (first == RotatingFrame::none) continue;
      for (std::size_t j = 0; j < frame.dimension(); ++j)
        terms.e[place_in_row(system, r, first + j)] += terms.w[k] * frame.entry(i - first, j);
    }
  }
}

}  // namespace

LinearTerms linear_terms(const System& system, const RotatingFrame& frame, const Instant& at,
                         std::span<const double> lambda) {
  auto e = system.evaluation();
  system.evaluate(at, e);
  auto slopes = system.linearisation();
  system.linearise(at, lambda, slopes);
  LinearTerms terms{{}, {}, std::move(e.w), std::move(slopes.psi_q)};
  for (std::size_t k = 0; k < slopes.stiffness.size(); ++k) {
    const auto [row, column] = system.stiffness_pattern()[k];
    append(terms.stiffness, row, column, -slopes.stiffness[k]);
  }
  for (std::size_t k = 0; k < slopes.damping.size(); ++k) {
    const System::Entry place = system.damping_pattern()[k];
    append(terms.damping, place.row, place.column, -slopes.damping[k]);
    if (frame.rotates()) append_rotating(frame, place, slopes.damping[k], terms.stiffness);
  }
  if (!frame.rotates()) return terms;
  append_inertia(system, frame, terms);
  add_rotating(system, frame, terms);
  return terms;
}

std::vector<LuPattern::Entry> TangentMatrix::entries(const System& system, const ActiveRows& rows,
                                                     const LinearTerms& terms) {
  const std::size_t n = system.coordinates();
  std::vector<LuPattern::Entry> entries;
  for (std::size_t i = 0; i < n; ++i) entries.push_back({i, i});
  for (std::size_t a = 0; a < rows.size(); ++a) {
    for (const std::size_t k : system.row(rows.rows[a])) {
      entries.push_back({system.w_columns()[k], n + a});
      entries.push_back({n + a, system.w_columns()[k]});
    }
    entries.push_back({n + a, n + a});
  }
  for (const auto& entry : terms.stiffness) entries.push_back({entry.row(), entry.col()});
  return entries;
}

TangentMatrix::TangentMatrix(const System& system, const ActiveRows& rows, const LinearTerms& terms, double s)
    : TangentMatrix(system, rows, terms, std::vector<double>(system.coordinates(), s)) {}

TangentMatrix::TangentMatrix(const System& system, const ActiveRows& rows, const LinearTerms& terms,
                             std::span<const double> s)
    : pattern_(system.coordinates() + rows.size(), entries(system, rows, terms)), lu_(pattern_) {
  std::size_t entry = 0;
  lu_.set_zero();
  for (std::size_t i = 0; i < s.size(); ++i) lu_.add(entry++, s[i] * system.masses()[i]);
  for (const std::size_t r : rows.rows) {
    for (const std::size_t k : system.row(r)) {
      lu_.add(entry++, -terms.w[k]);
      lu_.add(entry++, terms.w[k]);
    }
    lu_.add(entry++, system.law(r).compliance);
  }
  for (const auto& value : terms.stiffness) lu_.add(entry++, value.value());
  regular_ = lu_.factorise();
}

}  // namespace dalembert
