#include <dalembert/bench/kernels/scenes.h>
#include <dalembert/solvers/linear/kkt.h>
#include <dalembert/solvers/linear/ldl.h>
#include <dalembert/solvers/linear/schur.h>

#include <benchmark/benchmark.h>

#include <algorithm>

namespace dalembert::bench {
namespace {

/// Time per bead of a chain. Each solve has a fresh right-hand side: solved in place over and over it would
/// under- or overflow, and such numbers are slow.
template <class Matrix>
void solve(benchmark::State& state, const Problem& problem, Matrix& matrix) {
  if (!matrix.factorise(problem.w())) state.SkipWithError("singular");
  const std::vector<double> b = problem.right_hand_side();
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
void factorise(benchmark::State& state, const Problem& problem, Matrix& matrix) {
  bool regular = true;
  for (auto _ : state) regular = matrix.factorise(problem.w()) && regular;
  if (!regular) state.SkipWithError("singular");
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

/// S = W M^-1 W^T summed up and factored by LDL. What assembly takes of it is this less `ldl_factorise`.
void schur_assemble_and_factorise(benchmark::State& state) {
  const Problem problem = chain(static_cast<int>(state.range(0)));
  SchurComplement s(problem.system, problem.start.rows.rows);
  factorise(state, problem, s);
}

/// LDL alone, on a matrix of the pattern and kind of a chain's S: tridiagonal, positive definite.
void ldl_factorise(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  std::vector<SparseLdl::Entry> entries;
  for (std::size_t i = 0; i < n; ++i) {
    entries.push_back({i, i});
    if (i > 0) entries.push_back({i, i - 1});
  }
  SparseLdl matrix(n, entries);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    matrix.values()[matrix.place(k)] = entries[k].row == entries[k].column ? 2.0 : -0.5;
  }
  bool regular = true;
  for (auto _ : state) regular = matrix.factorise() && regular;
  if (!regular) state.SkipWithError("not positive definite");
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void schur_solve(benchmark::State& state) {
  const Problem problem = chain(static_cast<int>(state.range(0)));
  SchurComplement s(problem.system, problem.start.rows.rows);
  solve(state, problem, s);
}

/// [M -W^T; W 0] as a whole.
void klu_assemble_and_factorise(benchmark::State& state) {
  const Problem problem = chain(static_cast<int>(state.range(0)));
  KktMatrix kkt(problem.system, problem.start.rows, KktMatrix::Forces::none);
  factorise(state, problem, kkt);
}

void klu_solve(benchmark::State& state) {
  const Problem problem = chain(static_cast<int>(state.range(0)));
  KktMatrix kkt(problem.system, problem.start.rows, KktMatrix::Forces::none);
  solve(state, problem, kkt);
}

BENCHMARK(schur_assemble_and_factorise)->Arg(1000);
BENCHMARK(ldl_factorise)->Arg(1000);
BENCHMARK(schur_solve)->Arg(1000);
BENCHMARK(klu_assemble_and_factorise)->Arg(1000);
BENCHMARK(klu_solve)->Arg(1000);

}  // namespace
}  // namespace dalembert::bench
