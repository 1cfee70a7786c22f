#include "dalembert/solvers/linear/complement.h"

#include <algorithm>

namespace dalembert {

namespace {

struct Place {
  std::size_t row, entry;  // of the rows in use
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
  std::size_t own = 0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto entries = system.row(rows[r]);
    plan.rows.push_back({entries.front(), entries.front() + entries.size(), own});
    for (const std::size_t k : entries) by_coordinate[system.w_columns()[k]].push_back({r, own++});
  }
  struct Pair {
    std::size_t row, column, a, b;
  };
  std::vector<Pair> pairs;
  for (const auto& places : by_coordinate) {
    for (const Place& a : places) {
      for (const Place& b : places) {
        if (a.row <= b.row) pairs.push_back({a.row, b.row, a.entry, b.entry});
      }
    }
  }
  std::ranges::sort(pairs, [](const Pair& x, const Pair& y) {
    if (x.column != y.column) return x.column < y.column;
    if (x.row != y.row) return x.row < y.row;
    if (x.a + y.b != y.a + x.b) return x.a + y.b < y.a + x.b;  // by the diagonal a - b
    return x.a < y.a;
  });
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Pair& p = pairs[i];
    const bool continues = i > 0 && p.row == pairs[i - 1].row && p.column == pairs[i - 1].column &&
                           p.a == pairs[i - 1].a + 1 && p.b == pairs[i - 1].b + 1;
    if (continues) {
      ++plan.products.back().count;
    } else {
      const bool first_of_place =
          plan.entries.empty() || plan.entries.back().row != p.row || plan.entries.back().column != p.column;
      if (p.row == p.column && first_of_place) {
        const std::size_t row = rows[p.row];
        if (system.law(row).compliant()) plan.compliant.push_back({row, plan.entries.size()});
      }
      plan.entries.push_back({p.row, p.column});
      plan.products.push_back({0, p.a, p.b, 1});
    }
  }
  return plan;
}

ComplementPattern::ComplementPattern(const System& system, std::span<const std::size_t> rows)
    : ComplementPattern(system, plan(system, rows)) {}

ComplementPattern::ComplementPattern(const System& system, Plan plan)
    : rows_(std::move(plan.rows)),
      products_(std::move(plan.products)),
      compliant_(std::move(plan.compliant)),
      ldl_(rows_.size(), plan.entries) {
  for (const double m : system.masses()) inverse_mass_.push_back(1.0 / m);
  for (const Row& row : rows_) {
    for (std::size_t k = row.first; k < row.last; ++k) column_.push_back(system.w_columns()[k]);
  }
  for (std::size_t k = 0; k < products_.size(); ++k) products_[k].place = ldl_.place(k);
  std::ranges::stable_sort(products_, {}, &Product::place);
  for (Diagonal& d : compliant_) d.place = ldl_.place(d.place);
}

SchurComplement::SchurComplement(const ComplementPattern& pattern)
    : pattern_(&pattern), w_(pattern.column_.size()), v_(w_.size()), ldl_(pattern.ldl_) {}

bool SchurComplement::factorise(const SaddleValues& values) {
  const ComplementPattern& p = *pattern_;
  for (const auto& row : p.rows_) {
    std::size_t own = row.own;
    for (std::size_t k = row.first; k < row.last; ++k, ++own) {
      w_[own] = values.w[k];
      v_[own] = values.w[k] * p.inverse_mass_[p.column_[own]];
    }
  }
  const auto S = ldl_.values();
  const ComplementPattern::Product* before = nullptr;
  for (const auto& product : p.products_) {
    double sum = 0.0;
    for (std::size_t k = 0; k < product.count; ++k) sum += w_[product.a + k] * v_[product.b + k];
    double& value = S[product.place];
    value = before != nullptr && before->place == product.place ? value + sum : sum;
    before = &product;
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
  for (std::size_t r = 0; r < p.rows_.size(); ++r) {
    const std::size_t end = p.rows_[r].own + p.rows_[r].last - p.rows_[r].first;
    double sum = 0.0;
    for (std::size_t k = p.rows_[r].own; k < end; ++k) sum += v_[k] * x[p.column_[k]];
    y[r] -= sum;
  }
  ldl_.solve(y);
  for (std::size_t i = 0; i < n; ++i) x[i] *= p.inverse_mass_[i];
  for (std::size_t r = 0; r < p.rows_.size(); ++r) {
    const std::size_t end = p.rows_[r].own + p.rows_[r].last - p.rows_[r].first;
    for (std::size_t k = p.rows_[r].own; k < end; ++k) x[p.column_[k]] += v_[k] * y[r];
  }
}

}  // namespace dalembert
