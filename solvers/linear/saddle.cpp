#include "dalembert/solvers/linear/saddle.h"

#include <dalembert/solvers/base/constants.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

namespace {

/// Products per entry of W up to which the Schur complement is taken: a particle that 16
/// constraints share. Chosen, not measured: fill grows with the square, LU on the whole does not.
constexpr std::size_t most_products = 16;

bool has_sparse_complement(const System& system, std::span<const std::size_t> rows) {
  std::size_t entries = 0;
  for (const std::size_t r : rows) entries += system.row(r).size();
  return ComplementPattern::products(system, rows) <= most_products * entries;
}

std::size_t number(SaddleValues::Blocks blocks) { return static_cast<std::size_t>(blocks); }

}  // namespace

SaddlePattern::SaddlePattern(std::shared_ptr<const System> system, std::vector<std::size_t> rows,
                             std::vector<std::size_t> coordinates)
    : system_(std::move(system)),
      rows_(std::move(rows)),
      coordinates_(std::move(coordinates)),
      by_complement_(coordinates_.size() == system_->coordinates() &&
                     has_sparse_complement(*system_, rows_)) {}

const ComplementPattern& SaddlePattern::complement() const {
  if (!complement_) complement_.emplace(*system_, rows_);
  return *complement_;
}

const WholePattern& SaddlePattern::whole(SaddleValues::Blocks blocks) const {
  auto& own = whole_[number(blocks)];
  if (!own) own.emplace(*system_, rows_, coordinates_, blocks);
  return *own;
}

SaddlePattern::Analyses SaddlePattern::analyses() const {
  const auto klu = std::ranges::count_if(whole_, [](const auto& own) { return own.has_value(); });
  return {complement_ ? 1 : 0, static_cast<int>(klu)};
}

SaddleMatrix::SaddleMatrix(std::shared_ptr<const SaddlePattern> pattern, SaddleValues::Blocks blocks)
    : pattern_(std::move(pattern)) {
  if (blocks == SaddleValues::Blocks::symmetric && pattern_->by_complement()) {
    (void)complement();
  } else {
    (void)whole(blocks);
  }
}

SchurComplement& SaddleMatrix::complement() {
  if (!complement_) complement_.emplace(pattern_->complement());
  return *complement_;
}

WholeMatrix& SaddleMatrix::whole(SaddleValues::Blocks blocks) {
  in_use_ = number(blocks);
  auto& own = whole_[in_use_];
  if (!own) own.emplace(pattern_->whole(blocks));
  return *own;
}

bool SaddleMatrix::factorise(const SaddleValues& values) {
  ++factorisations_;
  const auto blocks = values.blocks();
  by_complement_ = false;
  if (blocks == SaddleValues::Blocks::symmetric && pattern_->by_complement()) {
    SchurComplement& own = complement();
    by_complement_ = own.factorise(values) && own.smallest_pivot() > constants.least_pivot;
  }
  return by_complement_ || whole(blocks).factorise(values);
}

double SaddleMatrix::sine() const {
  return complement_ ? std::sqrt(std::max(complement_->smallest_pivot(), 0.0)) : 1.0;
}

void SaddleMatrix::solve(std::span<double> x) {
  if (by_complement_) {
    complement_->solve(x);
  } else {
    whole_[in_use_]->solve(x);
  }
}

void SaddleMatrix::solve_refined(std::span<double> x) {
  if (by_complement_) {
    complement_->solve(x);
  } else {
    whole_[in_use_]->solve_refined(x);
  }
}

}  // namespace dalembert
