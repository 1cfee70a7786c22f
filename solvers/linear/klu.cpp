#include "dalembert/solvers/linear/klu.h"

#include <dalembert/solvers/base/constants.h>

#include <klu.h>

#include <algorithm>
#include <cassert>
#include <numeric>

namespace dalembert {

namespace {

struct FreeSymbolic {
  klu_common* common;
  void operator()(klu_symbolic* p) const { klu_free_symbolic(&p, common); }
};
struct FreeNumeric {
  klu_common* common;
  void operator()(klu_numeric* p) const { klu_free_numeric(&p, common); }
};

}  // namespace

struct SparseLU::State {
  klu_common common{};
  int size = 0;
  std::vector<int> column_start, row;  // compressed columns
  std::vector<double> value;
  std::vector<std::size_t> place;  // of the k-th entry of the list
  std::unique_ptr<klu_symbolic, FreeSymbolic> symbolic{nullptr, {&common}};
  std::unique_ptr<klu_numeric, FreeNumeric> numeric{nullptr, {&common}};
  double condition_when_pivoted = 0.0;
  long factorisations = 0;
  std::vector<char> seen;  // for sign_of_permutation

  [[nodiscard]] int sign_of_permutation(const int* permutation);
  void compress(std::span<const Entry> entries);
  bool pivot();
};

SparseLU::SparseLU(std::size_t size, std::span<const Entry> entries) : state_(std::make_unique<State>()) {
  klu_defaults(&state_->common);
  state_->size = static_cast<int>(size);
  state_->seen.resize(size);
  state_->compress(entries);
  state_->symbolic.reset(
      klu_analyze(state_->size, state_->column_start.data(), state_->row.data(), &state_->common));
}
SparseLU::SparseLU(SparseLU&&) noexcept = default;
SparseLU::~SparseLU() = default;

void SparseLU::State::compress(std::span<const Entry> entries) {
  std::vector<std::size_t> order(entries.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto before = [&](std::size_t a, std::size_t b) {
    return std::pair(entries[a].column, entries[a].row) < std::pair(entries[b].column, entries[b].row);
  };
  std::ranges::sort(order, before);
  column_start.assign(seen.size() + 1, 0);
  place.resize(entries.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || before(order[i - 1], order[i])) {
      row.push_back(static_cast<int>(entries[order[i]].row));
      ++column_start[entries[order[i]].column + 1];
    }
    place[order[i]] = row.size() - 1;
  }
  std::partial_sum(column_start.begin(), column_start.end(), column_start.begin());
  value.assign(row.size(), 0.0);
}

std::size_t SparseLU::size() const { return state_->seen.size(); }

void SparseLU::set_zero() { std::ranges::fill(state_->value, 0.0); }

void SparseLU::add(std::size_t k, double value) { state_->value[state_->place[k]] += value; }

bool SparseLU::State::pivot() {
  numeric.reset(klu_factor(column_start.data(), row.data(), value.data(), symbolic.get(), &common));
  if (!numeric || common.status != KLU_OK) return false;
  klu_rcond(symbolic.get(), numeric.get(), &common);
  condition_when_pivoted = common.rcond;
  return common.rcond > 0.0;
}

bool SparseLU::factorise() {
  State& s = *state_;
  if (!s.symbolic) return false;  // structurally hopeless, or out of memory
  ++s.factorisations;
  if (!s.numeric) return s.pivot();
  const bool same_pivots_serve = klu_refactor(s.column_start.data(), s.row.data(), s.value.data(),
                                              s.symbolic.get(), s.numeric.get(), &s.common) != 0 &&
                                 s.common.status == KLU_OK &&
                                 klu_rcond(s.symbolic.get(), s.numeric.get(), &s.common) != 0 &&
                                 s.common.rcond > constants.tolerated_loss * s.condition_when_pivoted;
  return same_pivots_serve || s.pivot();
}

void SparseLU::solve(std::span<double> x) {
  assert(state_->numeric && x.size() == size());
  klu_solve(state_->symbolic.get(), state_->numeric.get(), state_->size, 1, x.data(), &state_->common);
}

/// Each cycle of even length changes it.
int SparseLU::State::sign_of_permutation(const int* permutation) {
  std::ranges::fill(seen, 0);
  int sign = 1;
  for (int start = 0; start < size; ++start) {
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
  int sign = s.sign_of_permutation(s.numeric->Pnum) * s.sign_of_permutation(s.symbolic->Q);
  const auto* pivot = static_cast<const double*>(s.numeric->Udiag);
  for (int i = 0; i < s.size; ++i) {
    if (pivot[i] == 0.0) return 0;
    if (pivot[i] < 0.0) sign = -sign;
  }
  return sign;
}

long SparseLU::factorisations() const { return state_->factorisations; }

}  // namespace dalembert
