#include "dalembert/solvers/linear/ldl.h"

extern "C" {  // SuiteSparse 5's ldl.h does not say so itself
#include <ldl.h>
}
#include <amd.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace dalembert {

namespace {

/// A pivot below this part of its diagonal entry is round-off: each is a difference of sums of a
/// few terms, good to a few units of precision of that entry.
constexpr double round_off = 64.0 * std::numeric_limits<double>::epsilon();

}  // namespace

struct SparseLdl::State {
  int size = 0;
  std::vector<int> column_start, row;  // upper triangle in compressed columns, in the order of elimination
  std::vector<double> value;
  std::vector<std::size_t> place;     // of the k-th entry of the list
  std::vector<std::size_t> position;  // of each row in the order of elimination; empty if it is the given one
  std::vector<std::size_t> diagonal;  // place of each diagonal entry
  std::vector<int> parent, l_start, l_count, l_row, flag, pattern;
  std::vector<double> l_value, pivot, work;
  double smallest_pivot = 0.0;

  void compress(std::span<const Entry> entries);
  int analyse();
  [[nodiscard]] int order_by_amd(std::vector<int>& order) const;
  [[nodiscard]] std::size_t position_of(std::size_t r) const { return position.empty() ? r : position[r]; }
};

SparseLdl::SparseLdl(std::size_t n, std::span<const Entry> entries) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.size = static_cast<int>(n);
  s.parent.resize(n);
  s.l_start.resize(n + 1);
  s.l_count.resize(n);
  s.flag.resize(n);
  s.pattern.resize(n);
  s.pivot.resize(n);
  s.work.resize(n);

  s.compress(entries);
  int fill = s.analyse();
  std::vector<int> order(n);
  if (fill > s.size && s.order_by_amd(order) < fill) {
    s.position.resize(n);
    for (std::size_t i = 0; i < n; ++i) s.position[static_cast<std::size_t>(order[i])] = i;
    s.compress(entries);
    fill = s.analyse();
  }
  s.l_row.resize(static_cast<std::size_t>(fill));
  s.l_value.resize(static_cast<std::size_t>(fill));
}
SparseLdl::SparseLdl(SparseLdl&&) noexcept = default;
SparseLdl::~SparseLdl() = default;

void SparseLdl::State::compress(std::span<const Entry> entries) {
  struct Placed {
    std::size_t column, row, entry;
    [[nodiscard]] bool shares_place(const Placed& b) const { return column == b.column && row == b.row; }
  };
  std::vector<Placed> sorted;
  sorted.reserve(entries.size());
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const auto [low, high] = std::minmax({position_of(entries[k].row), position_of(entries[k].column)});
    sorted.push_back({high, low, k});
  }
  std::ranges::sort(sorted, [](const Placed& a, const Placed& b) {
    return a.column != b.column ? a.column < b.column : a.row < b.row;
  });
  column_start.assign(pivot.size() + 1, 0);
  row.clear();
  place.resize(entries.size());
  diagonal.assign(pivot.size(), 0);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i == 0 || !sorted[i].shares_place(sorted[i - 1])) {
      row.push_back(static_cast<int>(sorted[i].row));
      ++column_start[sorted[i].column + 1];
    }
    place[sorted[i].entry] = row.size() - 1;
    if (sorted[i].row == sorted[i].column) diagonal[sorted[i].row] = place[sorted[i].entry];
  }
  std::partial_sum(column_start.begin(), column_start.end(), column_start.begin());
  value.assign(row.size(), 0.0);
}

int SparseLdl::State::analyse() {
  ldl_symbolic(size, column_start.data(), row.data(), l_start.data(), parent.data(), l_count.data(),
               flag.data(), nullptr, nullptr);
  return l_start.back();
}

/// The order that AMD proposes; returns its fill, or more than any if AMD fails.
int SparseLdl::State::order_by_amd(std::vector<int>& order) const {
  double info[AMD_INFO];
  const int status = amd_order(size, column_start.data(), row.data(), order.data(), nullptr, info);
  const bool good = status == AMD_OK || status == AMD_OK_BUT_JUMBLED;
  return good ? static_cast<int>(info[AMD_LNZ]) : std::numeric_limits<int>::max();
}

std::size_t SparseLdl::size() const { return state_->pivot.size(); }
std::size_t SparseLdl::place(std::size_t k) const { return state_->place[k]; }
std::span<double> SparseLdl::values() { return state_->value; }
double SparseLdl::smallest_pivot() const { return state_->smallest_pivot; }
std::size_t SparseLdl::fill() const { return state_->l_row.size(); }

bool SparseLdl::factorise() {
  State& s = *state_;
  if (s.size == 1) {  // a lone rod or surface: LDL would spend ten times as long on being called
    s.pivot[0] = s.value[0];
    s.smallest_pivot = s.value[0] > 0.0 ? 1.0 : 0.0;
    return s.value[0] > 0.0;
  }
  s.smallest_pivot = 0.0;
  const int factored =
      ldl_numeric(s.size, s.column_start.data(), s.row.data(), s.value.data(), s.l_start.data(),
                  s.parent.data(), s.l_count.data(), s.l_row.data(), s.l_value.data(), s.pivot.data(),
                  s.work.data(), s.pattern.data(), s.flag.data(), nullptr, nullptr);
  if (factored != s.size) {
    std::ranges::fill(s.work, 0.0);  // LDL expects its work space clean
    return false;
  }
  double smallest = 1.0;
  for (std::size_t i = 0; i < s.pivot.size(); ++i) {
    const double ratio = s.pivot[i] / s.value[s.diagonal[i]];
    if (!(ratio >= smallest)) smallest = ratio;
  }
  s.smallest_pivot = smallest;
  return smallest > round_off;
}

void SparseLdl::solve(std::span<double> x) {
  State& s = *state_;
  if (s.size == 1) {
    x[0] /= s.pivot[0];
    return;
  }
  const std::span<double> y = s.position.empty() ? x : std::span(s.work);
  for (std::size_t i = 0; i < s.position.size(); ++i) y[s.position[i]] = x[i];
  ldl_lsolve(s.size, y.data(), s.l_start.data(), s.l_row.data(), s.l_value.data());
  ldl_dsolve(s.size, y.data(), s.pivot.data());
  ldl_ltsolve(s.size, y.data(), s.l_start.data(), s.l_row.data(), s.l_value.data());
  if (s.position.empty()) return;
  for (std::size_t i = 0; i < s.position.size(); ++i) x[i] = y[s.position[i]];
  std::ranges::fill(y, 0.0);
}

}  // namespace dalembert
