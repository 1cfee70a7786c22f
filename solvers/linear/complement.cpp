#include "dalembert/solvers/linear/complement.h"

#include <algorithm>

namespace dalembert {

namespace {

struct Place {
  std::size_t row, w, v;  // of the rows in use; the number of an entry in W and in V
};

}  // namespace

std::size_t ComplementPattern::products(const System& system, std::span<const std::size_t> rows) {
  std::vector<std::size_t> count(system.coordinates(), 0);
  for (const std::size_t r : rows) {
    for (const std::size_t k : system.row(r)) ++count[system.w_columns()[k]];
  }
  std::size_t sum = 0;
  for (const std::size_t c : count) sum += c * c;
  return sum;
}

/// Pairs up the entries of W that share a coordinate; pairs that continue one another become one
/// product.
ComplementPattern::Plan ComplementPattern::plan(const System& system, std::span<const std::size_t> rows) {
  Plan plan;
  std::vector<std::vector<Place>> by_coordinate(system.coordinates());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (const std::size_t k : system.row(rows[r])) {
      const std::size_t column = system.w_columns()[k];
      by_coordinate[column].push_back({r, k, plan.entries.size()});
      plan.entries.push_back({k, column});
    }
    plan.row_end.push_back(plan.entries.size());
  }
  struct Pair {
    std::size_t row, column, w, v;
  };
  std::vector<Pair> pairs;
  for (const auto& places : by_coordinate) {
    for (const Place& a : places) {
      for (const Place& b : places) {
        if (a.row <= b.row) pairs.push_back({a.row, b.row, a.w, b.v});
      }
    }
  }
  std::ranges::sort(pairs, [](const Pair& x, const Pair& y) {
    if (x.column != y.column) return x.column < y.column;
    if (x.row != y.row) return x.row < y.row;
    if (x.w + y.v != y.w + x.v) return x.w + y.v < y.w + x.v;  // by the diagonal w - v
    return x.w < y.w;
  });
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Pair& p = pairs[i];
    const bool continues = i > 0 && p.row == pairs[i - 1].row && p.column == pairs[i - 1].column &&
                           p.w == pairs[i - 1].w + 1 && p.v == pairs[i - 1].v + 1;
    if (continues) {
      ++plan.products.back().count;
    } else {
      const bool first_of_place =
          plan.places.empty() || plan.places.back().row != p.row || plan.places.back().column != p.column;
      if (p.row == p.column && first_of_place) {
        const std::size_t row = rows[p.row];
        if (system.law(row).compliant()) plan.compliant.push_back({row, plan.places.size()});
      }
      plan.places.push_back({p.row, p.column});
      plan.products.push_back({.place = 0, .w = p.w, .v = p.v, .count = 1});
    }
  }
  return plan;
}

ComplementPattern::ComplementPattern(const System& system, std::span<const std::size_t> rows)
    : ComplementPattern(system, plan(system, rows)) {}

ComplementPattern::ComplementPattern(const System& system, Plan plan)
    : entries_(std::move(plan.entries)),
      row_end_(std::move(plan.row_end)),
      products_(std::move(plan.products)),
      compliant_(std::move(plan.compliant)),
      ldl_(row_end_.size(), plan.places) {
  for (const double m : system.masses()) inverse_mass_.push_back(1.0 / m);
  for (std::size_t k = 0; k < products_.size(); ++k) products_[k].place = ldl_.place(k);
  std::ranges::stable_sort(products_, {}, &Product::place);
  for (std::size_t k = 0; k < products_.size(); ++k)
    products_[k].first = k == 0 || products_[k].place != products_[k - 1].place;
  for (Diagonal& d : compliant_) d.place = ldl_.place(d.place);
}

SchurComplement::SchurComplement(const ComplementPattern& pattern)
    : pattern_(&pattern), v_(pattern.entries_.size()), ldl_(pattern.ldl_) {}

bool SchurComplement::factorise(const SaddleValues& values) {
  const ComplementPattern& p = *pattern_;
  for (std::size_t k = 0; k < v_.size(); ++k)
    v_[k] = values.w[p.entries_[k].w] * p.inverse_mass_[p.entries_[k].column];
  const auto S = ldl_.values();
  for (const auto& product : p.products_) {
    double sum = 0.0;
    for (std::size_t k = 0; k < product.count; ++k) sum += values.w[product.w + k] * v_[product.v + k];
    S[product.place] = product.first ? sum : S[product.place] + sum;
  }
  if (!values.s.empty()) {
    for (const auto& d : p.compliant_) S[d.place] += values.s[d.row];
  }
  return ldl_.factorise();
}

void SchurComplement::solve(std::span<double> x) {
  const ComplementPattern& p = *pattern_;
  const std::size_t n = p.inverse_mass_.size();
  const auto y = x.subspan(n);
  std::size_t k = 0;
  for (std::size_t r = 0; r < p.row_end_.size(); ++r) {
    double sum = 0.0;
    for (; k < p.row_end_[r]; ++k) sum += v_[k] * x[p.entries_[k].column];
    y[r] -= sum;
  }
  ldl_.solve(y);
  for (std::size_t i = 0; i < n; ++i) x[i] *= p.inverse_mass_[i];
  k = 0;
  for (std::size_t r = 0; r < p.row_end_.size(); ++r)
    for (; k < p.row_end_[r]; ++k) x[p.entries_[k].column] += v_[k] * y[r];
}

}  // namespace dalembert
