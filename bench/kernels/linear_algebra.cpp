#include <dalembert/bench/kernels/scenes.h>
#include <dalembert/solvers/linear/ldl.h>
#include <dalembert/solvers/linear/saddle.h>

#include <benchmark/benchmark.h>

#include <algorithm>

namespace dalembert::bench {
namespace {

/// Time per bead of a chain. Each solve has a fresh right-hand side: solved in place over and over it would
/// under- or overflow, and such numbers are slow.
template <class Matrix>
void solve(benchmark::State& state, const Posed& posed, Matrix& matrix) {
  if (!matrix.factorise({.w = posed.w()})) state.SkipWithError("singular");
  const std::vector<double> b = posed.right_hand_side();
  std::vector<double> x = b;
  for (auto _ : state) {
    std::ranges::copy(b, x.begin());
    matrix.solve(x);
    benchmark::DoNotOptimize(x.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

template <class Matrix>
void factorise(benchmark::State& state, const Posed& posed, Matrix& matrix) {
  bool regular = true;
  for (auto _ : state) regular = matrix.factorise({.w = posed.w()}) && regular;
  if (!regular) state.SkipWithError("singular");
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

/// S = W M^-1 W^T summed up and factored by LDL. What assembly takes of it is this less `ldl_factorise`.
void schur_assemble_and_factorise(benchmark::State& state) {
  const Posed posed = chain(static_cast<int>(state.range(0)));
  SchurComplement s(posed.pattern()->complement());
  factorise(state, posed, s);
}

/// LDL alone, on a matrix of the pattern and kind of a chain's S: tridiagonal, positive definite.
void ldl_factorise(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  std::vector<LdlPattern::Entry> entries;
  for (std::size_t i = 0; i < n; ++i) {
    entries.push_back({i, i});
    if (i > 0) entries.push_back({i, i - 1});
  }
  const LdlPattern pattern(n, entries);
  SparseLdl matrix(pattern);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    matrix.values()[pattern.place(k)] = entries[k].row == entries[k].column ? 2.0 : -0.5;
  }
  bool regular = true;
  for (auto _ : state) regular = matrix.factorise() && regular;
  if (!regular) state.SkipWithError("not positive definite");
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void schur_solve(benchmark::State& state) {
  const Posed posed = chain(static_cast<int>(state.range(0)));
  SchurComplement s(posed.pattern()->complement());
  solve(state, posed, s);
}

/// [M -W^T; W 0] as a whole.
void klu_assemble_and_factorise(benchmark::State& state) {
  const Posed posed = chain(static_cast<int>(state.range(0)));
  WholeMatrix whole(posed.pattern()->whole(SaddleValues::Blocks::symmetric));
  factorise(state, posed, whole);
}

void klu_solve(benchmark::State& state) {
  const Posed posed = chain(static_cast<int>(state.range(0)));
  WholeMatrix whole(posed.pattern()->whole(SaddleValues::Blocks::symmetric));
  solve(state, posed, whole);
}

BENCHMARK(schur_assemble_and_factorise)->Arg(1000);
BENCHMARK(ldl_factorise)->Arg(1000);
BENCHMARK(schur_solve)->Arg(1000);
BENCHMARK(klu_assemble_and_factorise)->Arg(1000);
BENCHMARK(klu_solve)->Arg(1000);

}  // namespace
}  // namespace dalembert::bench
