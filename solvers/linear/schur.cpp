#include "dalembert/solvers/linear/schur.h"

#include <algorithm>

namespace dalembert {

namespace {

struct Place {
  std::size_t row, entry;  // of the rows in use
};

}  // namespace

std::size_t SchurComplement::products(const System& system, std::span<const std::size_t> rows) {
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
SchurComplement::Plan SchurComplement::plan(const System& system, std::span<const std::size_t> rows) {
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
        if (system.compliance()[row] > 0.0) plan.compliant.push_back({row, plan.entries.size()});
      }
      plan.entries.push_back({p.row, p.column});
      plan.products.push_back({0, p.a, p.b, 1});
    }
  }
  return plan;
}

SchurComplement::SchurComplement(const System& system, std::span<const std::size_t> rows)
    : SchurComplement(system, plan(system, rows)) {}

SchurComplement::SchurComplement(const System& system, Plan plan)
    : rows_(std::move(plan.rows)),
      products_(std::move(plan.products)),
      compliant_(std::move(plan.compliant)),
      ldl_(rows_.size(), plan.entries) {
  for (const double m : system.masses()) inverse_mass_.push_back(1.0 / m);
  for (const Row& row : rows_) {
    for (std::size_t k = row.first; k < row.last; ++k) column_.push_back(system.w_columns()[k]);
  }
  w_.resize(column_.size());
  v_.resize(column_.size());
  for (std::size_t k = 0; k < products_.size(); ++k) products_[k].place = ldl_.place(k);
  std::ranges::stable_sort(products_, {}, &Product::place);
  for (Diagonal& d : compliant_) d.place = ldl_.place(d.place);
}

bool SchurComplement::factorise(std::span<const double> w, std::span<const double> s) {
  for (const Row& row : rows_) {
    std::size_t own = row.own;
    for (std::size_t k = row.first; k < row.last; ++k, ++own) {
      w_[own] = w[k];
      v_[own] = w[k] * inverse_mass_[column_[own]];
    }
  }
  const auto values = ldl_.values();
  const Product* before = nullptr;
  for (const Product& p : products_) {
    double sum = 0.0;
    for (std::size_t k = 0; k < p.count; ++k) sum += w_[p.a + k] * v_[p.b + k];
    double& value = values[p.place];
    value = before != nullptr && before->place == p.place ? value + sum : sum;
    before = &p;
  }
  if (!s.empty()) {
    for (const Diagonal& d : compliant_) values[d.place] += s[d.row];
  }
  return ldl_.factorise();
}

void SchurComplement::solve(std::span<double> x) {
  const std::size_t n = inverse_mass_.size();
  const auto y = x.subspan(n);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const std::size_t end = rows_[r].own + rows_[r].last - rows_[r].first;
    double sum = 0.0;
    for (std::size_t k = rows_[r].own; k < end; ++k) sum += v_[k] * x[column_[k]];
    y[r] -= sum;
  }
  ldl_.solve(y);
  for (std::size_t i = 0; i < n; ++i) x[i] *= inverse_mass_[i];
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const std::size_t end = rows_[r].own + rows_[r].last - rows_[r].first;
    for (std::size_t k = rows_[r].own; k < end; ++k) x[column_[k]] += v_[k] * y[r];
  }
}

}  // namespace dalembert
