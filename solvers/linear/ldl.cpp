#include "dalembert/solvers/linear/ldl.h"

#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/linear/mutable_data.h>

extern "C" {  // SuiteSparse 5's ldl.h lacks the guard
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
constexpr double least_pivot = 64.0 * epsilon;

}  // namespace

LdlPattern::LdlPattern(std::size_t n, std::span<const Entry> entries)
    : diagonal_(n), parent_(n), l_start_(n + 1) {
  compress(entries);
  analyse();
  std::vector<int> order(n);
  if (fill() <= static_cast<int>(n) || order_by_amd(order) >= fill()) return;
  position_.resize(n);
  for (std::size_t i = 0; i < n; ++i) position_[static_cast<std::size_t>(order[i])] = i;
  compress(entries);
  analyse();
}

void LdlPattern::compress(std::span<const Entry> entries) {
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
  column_start_.assign(size() + 1, 0);
  row_.clear();
  place_.resize(entries.size());
  diagonal_.assign(size(), 0);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i == 0 || !sorted[i].shares_place(sorted[i - 1])) {
      row_.push_back(static_cast<int>(sorted[i].row));
      ++column_start_[sorted[i].column + 1];
    }
    place_[sorted[i].entry] = row_.size() - 1;
    if (sorted[i].row == sorted[i].column) diagonal_[sorted[i].row] = place_[sorted[i].entry];
  }
  std::partial_sum(column_start_.begin(), column_start_.end(), column_start_.begin());
}

void LdlPattern::analyse() {
  std::vector<int> l_count(size()), flag(size());
  ldl_symbolic(static_cast<int>(size()), column_start_.data(), row_.data(), l_start_.data(), parent_.data(),
               l_count.data(), flag.data(), nullptr, nullptr);
}

/// The order that AMD proposes; returns its fill, or more than any if AMD fails.
int LdlPattern::order_by_amd(std::vector<int>& order) const {
  double info[AMD_INFO];
  const int status =
      amd_order(static_cast<int>(size()), column_start_.data(), row_.data(), order.data(), nullptr, info);
  const bool good = status == AMD_OK || status == AMD_OK_BUT_JUMBLED;
  return good ? static_cast<int>(info[AMD_LNZ]) : std::numeric_limits<int>::max();
}

SparseLdl::SparseLdl(const LdlPattern& pattern)
    : pattern_(&pattern), value_(pattern.row_.size()), pivot_(pattern.size()) {
  if (pattern.size() <= 1) return;
  l_value_.resize(static_cast<std::size_t>(pattern.fill()));
  l_row_.resize(l_value_.size());
  work_.resize(pattern.size());
  for (auto* each : {&l_count_, &flag_, &nonzeros_}) each->resize(pattern.size());
}

bool SparseLdl::factorise() {
  if (pivot_.size() == 1) {  // a lone rod or surface: LDL would spend ten times as long on being called
    pivot_[0] = value_[0];
    smallest_pivot_ = value_[0] > 0.0 ? 1.0 : 0.0;
    return value_[0] > 0.0;
  }
  smallest_pivot_ = 0.0;
  const LdlPattern& p = *pattern_;
  const auto size = static_cast<int>(pivot_.size());
  const int factored = ldl_numeric(size, mutable_data(p.column_start_), mutable_data(p.row_), value_.data(),
                                   mutable_data(p.l_start_), mutable_data(p.parent_), l_count_.data(),
                                   l_row_.data(), l_value_.data(), pivot_.data(), work_.data(),
                                   nonzeros_.data(), flag_.data(), nullptr, nullptr);
  if (factored != size) {
    std::ranges::fill(work_, 0.0);  // LDL expects its work space clean
    return false;
  }
  double smallest = 1.0;
  for (std::size_t i = 0; i < pivot_.size(); ++i) {
    const double ratio = pivot_[i] / value_[p.diagonal_[i]];
    if (!(ratio >= smallest)) smallest = ratio;
  }
  smallest_pivot_ = smallest;
  return smallest > least_pivot;
}

void SparseLdl::solve(std::span<double> x) {
  if (pivot_.size() == 1) {
    x[0] /= pivot_[0];
    return;
  }
  const auto& position = pattern_->position_;
  const auto size = static_cast<int>(pivot_.size());
  int* const l_start = mutable_data(pattern_->l_start_);
  const std::span<double> y = position.empty() ? x : std::span(work_);
  for (std::size_t i = 0; i < position.size(); ++i) y[position[i]] = x[i];
  ldl_lsolve(size, y.data(), l_start, l_row_.data(), l_value_.data());
  ldl_dsolve(size, y.data(), pivot_.data());
  ldl_ltsolve(size, y.data(), l_start, l_row_.data(), l_value_.data());
  if (position.empty()) return;
  for (std::size_t i = 0; i < position.size(); ++i) x[i] = y[position[i]];
  std::ranges::fill(y, 0.0);
}

}  // namespace dalembert
