#include "dalembert/solvers/linear/klu.h"

#include <dalembert/solvers/base/constants.h>
#include <dalembert/solvers/linear/mutable_data.h>

#include <klu.h>

#include <algorithm>
#include <cassert>
#include <numeric>

namespace dalembert {

struct LuPattern::State {
  struct Free {
    klu_common* common;
    void operator()(klu_symbolic* p) const { klu_free_symbolic(&p, common); }
  };

  State(std::size_t size, std::span<const Entry> entries);

  std::size_t size;
  std::vector<int> column_start, row;  // compressed columns
  std::vector<std::size_t> place;      // of the k-th entry of the list
  klu_common common{};
  std::unique_ptr<klu_symbolic, Free> symbolic{nullptr, {&common}};

 private:
  void compress(std::span<const Entry> entries);
};

LuPattern::State::State(std::size_t n, std::span<const Entry> entries) : size(n) {
  klu_defaults(&common);
  compress(entries);
  symbolic.reset(klu_analyze(static_cast<int>(size), column_start.data(), row.data(), &common));
}

void LuPattern::State::compress(std::span<const Entry> entries) {
  std::vector<std::size_t> order(entries.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto before = [&](std::size_t a, std::size_t b) {
    return std::pair(entries[a].column, entries[a].row) < std::pair(entries[b].column, entries[b].row);
  };
  std::ranges::sort(order, before);
  column_start.assign(size + 1, 0);
  place.resize(entries.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || before(order[i - 1], order[i])) {
      row.push_back(static_cast<int>(entries[order[i]].row));
      ++column_start[entries[order[i]].column + 1];
    }
    place[order[i]] = row.size() - 1;
  }
  std::partial_sum(column_start.begin(), column_start.end(), column_start.begin());
}

LuPattern::LuPattern(std::size_t size, std::span<const Entry> entries)
    : state_(std::make_unique<const State>(size, entries)) {}
LuPattern::LuPattern(LuPattern&&) noexcept = default;
LuPattern::~LuPattern() = default;

std::size_t LuPattern::size() const { return state_->size; }

struct SparseLU::State {
  struct Free {
    klu_common* common;
    void operator()(klu_numeric* p) const { klu_free_numeric(&p, common); }
  };

  explicit State(const LuPattern::State& of)
      : pattern(&of), value(of.row.size()), residual(of.size), seen(of.size) {
    klu_defaults(&common);
  }

  const LuPattern::State* pattern;
  klu_common common{};
  std::vector<double> value, residual;
  std::unique_ptr<klu_numeric, Free> numeric{nullptr, {&common}};
  double condition_when_pivoted = 0.0;
  std::vector<char> seen;  // for sign_of_permutation

  [[nodiscard]] int sign_of_permutation(const int* permutation);
  bool pivot();
};

SparseLU::SparseLU(const LuPattern& pattern) : state_(std::make_unique<State>(*pattern.state_)) {}
SparseLU::SparseLU(SparseLU&&) noexcept = default;
SparseLU::~SparseLU() = default;

void SparseLU::set_zero() { std::ranges::fill(state_->value, 0.0); }

void SparseLU::add(std::size_t k, double value) { state_->value[state_->pattern->place[k]] += value; }

bool SparseLU::State::pivot() {
  numeric.reset(klu_factor(mutable_data(pattern->column_start), mutable_data(pattern->row), value.data(),
                           pattern->symbolic.get(), &common));
  if (!numeric || common.status != KLU_OK) return false;
  klu_rcond(pattern->symbolic.get(), numeric.get(), &common);
  condition_when_pivoted = common.rcond;
  return common.rcond > 0.0;
}

bool SparseLU::factorise() {
  State& s = *state_;
  klu_symbolic* const symbolic = s.pattern->symbolic.get();
  if (symbolic == nullptr) return false;  // structurally hopeless, or out of memory
  if (!s.numeric) return s.pivot();
  const bool same_pivots_serve =
      klu_refactor(mutable_data(s.pattern->column_start), mutable_data(s.pattern->row), s.value.data(),
                   symbolic, s.numeric.get(), &s.common) != 0 &&
      s.common.status == KLU_OK && klu_rcond(symbolic, s.numeric.get(), &s.common) != 0 &&
      s.common.rcond > constants.tolerated_loss * s.condition_when_pivoted;
  return same_pivots_serve || s.pivot();
}

void SparseLU::solve(std::span<double> x) {
  State& s = *state_;
  assert(s.numeric && x.size() == s.seen.size());
  klu_solve(s.pattern->symbolic.get(), s.numeric.get(), s.pattern->symbolic->n, 1, x.data(), &s.common);
}

void SparseLU::solve_refined(std::span<double> x) {
  State& s = *state_;
  const LuPattern::State& p = *s.pattern;
  std::ranges::copy(x, s.residual.begin());
  solve(x);
  for (std::size_t j = 0; j < p.size; ++j)
    for (int k = p.column_start[j]; k < p.column_start[j + 1]; ++k) {
      const auto place = static_cast<std::size_t>(k);
      s.residual[static_cast<std::size_t>(p.row[place])] -= s.value[place] * x[j];
    }
  solve(s.residual);
  for (std::size_t i = 0; i < p.size; ++i) x[i] += s.residual[i];
}

/// Each cycle of even length changes it.
int SparseLU::State::sign_of_permutation(const int* permutation) {
  std::ranges::fill(seen, 0);
  int sign = 1;
  for (int start = 0; start < pattern->symbolic->n; ++start) {
    int length = 0;
    for (int i = start; !seen[static_cast<std::size_t>(i)]; i = permutation[i]) {
      seen[static_cast<std::size_t>(i)] = 1;
      ++length;
    }
    if (length > 0 && length % 2 == 0) sign = -sign;
  }
  return sign;
}

/// KLU has P R A Q = L U + F with R diagonal and positive, L's diagonal 1 and F above the diagonal blocks.
int SparseLU::sign_of_determinant() {
  State& s = *state_;
  if (!s.numeric) return 0;
  int sign = s.sign_of_permutation(s.numeric->Pnum) * s.sign_of_permutation(s.pattern->symbolic->Q);
  const auto* pivot = static_cast<const double*>(s.numeric->Udiag);
  for (std::size_t i = 0; i < s.pattern->size; ++i) {
    if (pivot[i] == 0.0) return 0;
    if (pivot[i] < 0.0) sign = -sign;
  }
  return sign;
}

}  // namespace dalembert
