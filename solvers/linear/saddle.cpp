#include "dalembert/solvers/linear/saddle.h"

#include <dalembert/solvers/base/constants.h>

#include <algorithm>
#include <cmath>

namespace dalembert {

namespace {

/// Products per entry of W up to which the Schur complement is taken: a particle that 16
/// constraints share. Chosen, not measured: fill grows with the square, LU on the whole does not.
constexpr std::size_t most_products = 16;

}  // namespace

bool SaddleMatrix::complement_suits(const System& system, const ActiveRows& rows) {
  std::size_t entries = 0;
  for (const std::size_t r : rows.rows) entries += system.row(r).size();
  return SchurComplement::products(system, rows.rows) <= most_products * entries;
}

SaddleMatrix::SaddleMatrix(const System& system, const ActiveRows& rows) : system_(&system), rows_(rows) {
  if (complement_suits(system, rows)) {
    schur_.emplace(system, rows_.rows);
  } else {
    whole_.emplace(system, rows, KktMatrix::Forces::none);
  }
}

bool SaddleMatrix::factorise(std::span<const double> w, std::span<const double> s) {
  ++factorisations_;
  by_schur_ = schur_ && schur_->factorise(w, s) && schur_->smallest_pivot() > constants.least_pivot;
  if (by_schur_) return true;
  if (!whole_) whole_.emplace(*system_, rows_, KktMatrix::Forces::none);
  return whole_->factorise(w, s);
}

double SaddleMatrix::sine() const {
  return schur_ ? std::sqrt(std::max(schur_->smallest_pivot(), 0.0)) : 1.0;
}

void SaddleMatrix::solve(std::span<double> x) {
  if (by_schur_) {
    schur_->solve(x);
  } else {
    whole_->solve(x);
  }
}

}  // namespace dalembert
