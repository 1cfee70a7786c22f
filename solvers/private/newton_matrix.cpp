#include "dalembert/solvers/private/newton_matrix.h"

#include <algorithm>
#include <cmath>

namespace dalembert {

namespace {

/// Newton's iteration loses at most this factor in accuracy by leaving soft forces out.
constexpr double still_soft = 0.1;

/// Whether there are forces besides constant ones: entries of the stiffness besides the constraints'.
bool has_varying_forces(const System& system) {
  std::size_t of_constraints = 0;
  for (const auto& c : system.layout()->constraints)
    of_constraints += static_cast<std::size_t>(c.width * c.width);
  return system.stiffness_pattern().size() > of_constraints;
}

ActiveRows holonomic_only(const ActiveRows& all) {
  return {{all.rows.begin(), all.rows.begin() + all.holonomic}, all.holonomic};
}

}  // namespace

NewtonMatrix::NewtonMatrix(const System& system, const ActiveRows& rows)
    : system_(&system),
      rows_(rows),
      linear_(system.linearisation()),
      w_(system.w_columns().size()),
      k2_(system, holonomic_only(rows)),
      x1_(static_cast<std::size_t>(system.coordinates() + rows.size())),
      x2_(static_cast<std::size_t>(system.coordinates() + rows.holonomic)),
      p_(static_cast<std::size_t>(system.coordinates())) {
  // Where it will be needed, before the first step: stepping allocates nothing.
  if (rows.holonomic != rows.size() || has_varying_forces(system)) make_stiff();
}

void NewtonMatrix::make_stiff() {
  if (k1_) return;
  k1_.emplace(*system_, rows_, KktMatrix::Forces::linearised);
  lower_.resize(w_.size());
}

/// Whether all rows are holonomic and H and D small against c^2 M and c M, by their largest row sums.
bool NewtonMatrix::judge_soft(double c) {
  if (rows_.holonomic != rows_.size()) return false;
  std::ranges::fill(p_, 0.0);
  for (std::size_t k = 0; k < linear_.stiffness.size(); ++k) {
    p_[static_cast<std::size_t>(system_->stiffness_pattern()[k].row)] +=
        std::abs(linear_.stiffness[k]) / (c * c);
  }
  for (std::size_t k = 0; k < linear_.damping.size(); ++k) {
    p_[static_cast<std::size_t>(system_->damping_pattern()[k].row)] += std::abs(linear_.damping[k]) / c;
  }
  const auto masses = system_->masses();
  for (std::size_t i = 0; i < p_.size(); ++i) {
    if (p_[i] > still_soft * masses[i]) return false;
  }
  return true;
}

bool NewtonMatrix::factorise(const Instant& at, const System::Evaluation& e, std::span<const double> lambda,
                             double c) {
  system_->linearise(at, lambda, linear_);
  soft_ = judge_soft(c);
  std::ranges::copy(e.w, w_.begin());
  if (!k2_.factorise(w_)) return false;
  if (soft_) return true;
  make_stiff();
  const auto first_nonholonomic =
      static_cast<std::size_t>(system_->row_start()[static_cast<std::size_t>(system_->holonomic_rows())]);
  std::copy(w_.begin(), w_.end(), lower_.begin());
  for (std::size_t k = first_nonholonomic; k < lower_.size(); ++k) lower_[k] += linear_.psi_q[k] / c;
  return k1_->factorise(w_, lower_, linear_, 1.0 / (c * c), 1.0 / c);
}

bool NewtonMatrix::refresh(const System::Evaluation& e) {
  if (!soft_) return true;
  std::ranges::copy(e.w, w_.begin());
  return k2_.factorise(w_);
}

double NewtonMatrix::along(std::size_t row, std::span<const double> values, std::span<const double> x) const {
  double sum = 0.0;
  for (auto k = static_cast<std::size_t>(system_->row_start()[row]);
       k < static_cast<std::size_t>(system_->row_start()[row + 1]); ++k) {
    sum += values[k] * x[static_cast<std::size_t>(system_->w_columns()[k])];
  }
  return sum;
}

void NewtonMatrix::solve(double c, std::span<double> b) {
  if (soft_) {
    solve_soft(c, b);
  } else {
    solve_stiff(c, b);
  }
}

/// (5) to (7) with H = D = 0, all rows holonomic.
void NewtonMatrix::solve_soft(double c, std::span<double> b) {
  const auto n = static_cast<std::size_t>(system_->coordinates());
  const auto m = static_cast<std::size_t>(rows_.size());
  const auto b1 = b.subspan(0, n);
  const auto b2 = b.subspan(n, n);
  const auto b3 = b.subspan(2 * n, m);
  const auto b4 = b.subspan(2 * n + m, m);
  const auto masses = system_->masses();
  for (std::size_t i = 0; i < n; ++i) x1_[i] = -b2[i] - c * b1[i];
  for (std::size_t r = 0; r < m; ++r) x1_[n + r] = c * c * b4[r];
  k2_.solve(x1_);
  for (std::size_t i = 0; i < n; ++i) {
    x2_[i] = b1[i] + masses[i] * x1_[i] / c;
    b1[i] = x1_[i] / (c * c);
  }
  for (std::size_t r = 0; r < m; ++r) {
    x2_[n + r] = b3[r] - along(static_cast<std::size_t>(rows_.rows[r]), linear_.psi_q, b1);
  }
  k2_.solve(x2_);
  std::copy_n(x2_.begin(), n, b2.begin());
  for (std::size_t r = 0; r < m; ++r) {
    b4[r] = -x2_[n + r];  // the matrix of (7) has -G^T
    b3[r] = x1_[n + r] - c * b4[r];
  }
}

/// (5) to (7), given p = dv - c dq as far as it is known; leaves dq, dnu in x1_ and dv, -dmu in x2_.
void NewtonMatrix::eliminate(double c, std::span<const double> b) {
  const auto n = static_cast<std::size_t>(system_->coordinates());
  const auto m = static_cast<std::size_t>(rows_.size());
  const auto m_holonomic = static_cast<std::size_t>(rows_.holonomic);
  const auto b1 = b.subspan(0, n);
  const auto b2 = b.subspan(n, n);
  const auto b3 = b.subspan(2 * n, m);
  const auto b4 = b.subspan(2 * n + m, m_holonomic);
  const auto masses = system_->masses();

  // (5), (6)
  for (std::size_t i = 0; i < n; ++i) x1_[i] = -b2[i] - c * b1[i];
  for (std::size_t k = 0; k < linear_.damping.size(); ++k) {
    const auto [row, column] = system_->damping_pattern()[k];
    x1_[static_cast<std::size_t>(row)] += linear_.damping[k] * p_[static_cast<std::size_t>(column)];
  }
  for (std::size_t r = 0; r < m; ++r) {
    const auto row = static_cast<std::size_t>(rows_.rows[r]);
    x1_[n + r] = r < m_holonomic ? c * c * b4[r] : c * (b3[r] - along(row, w_, p_));
  }
  k1_->solve(x1_);
  const auto dq = std::span(x1_).first(n);
  for (double& x : dq) x /= c * c;

  // (7)
  for (std::size_t i = 0; i < n; ++i) x2_[i] = b1[i] + c * masses[i] * dq[i];
  for (std::size_t r = 0; r < m_holonomic; ++r) {
    x2_[n + r] = b3[r] - along(static_cast<std::size_t>(rows_.rows[r]), linear_.psi_q, dq);
  }
  k2_.solve(x2_);
}

void NewtonMatrix::solve_stiff(double c, std::span<double> b) {
  const auto n = static_cast<std::size_t>(system_->coordinates());
  const auto m = static_cast<std::size_t>(rows_.size());
  const auto m_holonomic = static_cast<std::size_t>(rows_.holonomic);
  for (std::size_t i = 0; i < n; ++i) p_[i] = b[i] / system_->masses()[i];
  eliminate(c, b);
  if (m > m_holonomic && m_holonomic > 0) {
    for (std::size_t i = 0; i < n; ++i) p_[i] = x2_[i] - c * x1_[i];
    eliminate(c, b);
  }

  std::copy_n(x1_.begin(), n, b.begin());
  std::copy_n(x2_.begin(), n, b.begin() + static_cast<std::ptrdiff_t>(n));
  for (std::size_t r = 0; r < m; ++r) {
    const double dmu = r < m_holonomic ? -x2_[n + r] : 0.0;  // the matrix of (7) has -G^T
    b[2 * n + r] = x1_[n + r] - c * dmu;
    if (r < m_holonomic) b[2 * n + m + r] = dmu;
  }
}

}  // namespace dalembert
