#include "dalembert/solvers/equilibrium/linear_terms.h"

#include <dalembert/core/analysis/islands.h>
#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/mass_metric.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

namespace {

void append(LinearTerms::Entries& to, std::size_t row, std::size_t column, double value) {
  to.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
}

/// -F_v A, from an entry of F_v.
void append_rotating(const RotatingFrame& frame, const MatrixEntry& place, double slope,
                     LinearTerms::Entries& K) {
  const auto row = static_cast<Eigen::Index>(place.column);
  for (RotatingFrame::Sparse::InnerIterator a(frame.matrix(), row); a; ++a)
    append(K, place.row, static_cast<std::size_t>(a.col()), -slope * a.value());
}

/// m X, of a sparse X.
void append_inertia(const System& system, const RotatingFrame::Sparse& X, double factor,
                    LinearTerms::Entries& to) {
  for (std::size_t i = 0; i < system.coordinates(); ++i) {
    for (RotatingFrame::Sparse::InnerIterator x(X, static_cast<Eigen::Index>(i)); x; ++x)
      append(to, i, static_cast<std::size_t>(x.col()), factor * system.masses()[i] * x.value());
  }
}

/// The first entry of a row in this column: a row with one coordinate of a particle has them all, and of a
/// body all particles.
std::size_t place_in_row(const System& system, std::size_t row, std::size_t column) {
  for (const std::size_t k : system.row(row))
    if (system.w_columns()[k] == column) return k;
  throw InvalidScene(system.row_label(row) +
                     " acts on single particles of a body that spins; state it for points of the body");
}

/// E = psi_q + W A, with psi_q already in place.
void add_rotating(const System& system, const RotatingFrame& frame, LinearTerms& terms) {
  for (std::size_t r = system.holonomic_rows(); r < system.rows(); ++r) {
    for (const std::size_t k : system.row(r)) {
      const auto i = static_cast<Eigen::Index>(system.w_columns()[k]);
      for (RotatingFrame::Sparse::InnerIterator a(frame.matrix(), i); a; ++a)
        terms.e[place_in_row(system, r, static_cast<std::size_t>(a.col()))] += terms.w[k] * a.value();
    }
  }
}

/// With 0 for what is round-off of the forces of its uncoupled part, in the metric of the masses: that
/// spreads to all rows there.
std::vector<double> told_from_round_off(const System& system, const System::Evaluation& e,
                                        std::span<const double> lambda, double known) {
  const Islands parts = islands(system);
  const auto columns = system.w_columns();
  const auto masses = system.masses();
  std::vector<double> forces(masses.size()), squares(parts.count), told(lambda.begin(), lambda.end());
  for (std::size_t i = 0; i < forces.size(); ++i) forces[i] = std::abs(e.force[i]);
  for (std::size_t r = 0; r < told.size(); ++r)
    for (const std::size_t k : system.row(r)) forces[columns[k]] += std::abs(lambda[r] * e.w[k]);
  for (std::size_t i = 0; i < forces.size(); ++i)
    squares[parts.of_coordinate[i]] += forces[i] * forces[i] / masses[i];
  for (std::size_t r = 0; r < told.size(); ++r) {
    double own = 0.0;
    for (const std::size_t k : system.row(r)) {
      const double force = lambda[r] * e.w[k];
      own += force * force / masses[columns[k]];
    }
    if (std::sqrt(own) <= known * std::sqrt(squares[parts.of_row(system, r)])) told[r] = 0.0;
  }
  return told;
}

std::vector<LuPattern::Entry> tangent_entries(const System& system, const ActiveRows& rows,
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

using Pattern = TangentMatrix::Pattern;

/// The one that is known, if it still is the one.
std::shared_ptr<const Pattern> pattern_of(const System& system, const ActiveRows& rows,
                                          const LinearTerms& terms, std::shared_ptr<const Pattern> known) {
  const std::size_t size = system.coordinates() + rows.size();
  auto entries = tangent_entries(system, rows, terms);
  const auto same = [](const LuPattern::Entry& a, const LuPattern::Entry& b) {
    return a.row == b.row && a.column == b.column;
  };
  if (known && known->lu.size() == size && std::ranges::equal(known->entries, entries, same)) return known;
  LuPattern lu(size, entries);
  return std::make_shared<const Pattern>(Pattern{std::move(entries), std::move(lu)});
}

}  // namespace

LinearTerms linear_terms(const System& system, const RotatingFrame& frame, const Instant& at,
                         std::span<const double> lambda, double roundings) {
  auto e = system.evaluation();
  system.evaluate(at, e);
  auto slopes = system.linearisation();
  const double known = roundings_of_a_sum * epsilon * roundings;
  system.linearise(at, told_from_round_off(system, e, lambda, known), slopes);
  LinearTerms terms{{}, {}, std::move(e.w), std::move(slopes.psi_q), roundings};
  for (std::size_t k = 0; k < slopes.stiffness.size(); ++k) {
    const auto [row, column] = system.stiffness_pattern()[k];
    append(terms.stiffness, row, column, -slopes.stiffness[k]);
  }
  for (std::size_t k = 0; k < slopes.damping.size(); ++k) {
    const MatrixEntry place = system.forces().damping_pattern()[k];
    append(terms.damping, place.row, place.column, -slopes.damping[k]);
    if (frame.rotates()) append_rotating(frame, place, slopes.damping[k], terms.stiffness);
  }
  if (!frame.rotates()) return terms;
  append_inertia(system, frame.matrix(), 2.0, terms.damping);    // 2 M A
  append_inertia(system, frame.square(), 1.0, terms.stiffness);  // M A^2
  add_rotating(system, frame, terms);
  return terms;
}

TangentMatrix::TangentMatrix(const System& system, const ActiveRows& rows, const LinearTerms& terms, double s)
    : TangentMatrix(pattern_of(system, rows, terms, nullptr), system, rows, terms,
                    std::vector<double>(system.coordinates(), s)) {}

TangentMatrix::TangentMatrix(const System& system, const ActiveRows& rows, const LinearTerms& terms,
                             std::span<const double> s, std::shared_ptr<const Pattern>& known)
    : TangentMatrix(known = pattern_of(system, rows, terms, known), system, rows, terms, s) {}

TangentMatrix::TangentMatrix(std::shared_ptr<const Pattern> pattern, const System& system,
                             const ActiveRows& rows, const LinearTerms& terms, std::span<const double> s)
    : pattern_(std::move(pattern)), lu_(pattern_->lu) {
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
