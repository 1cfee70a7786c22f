#include "dalembert/solvers/ida/newton_matrix.h"

#include <dalembert/solvers/linear/rows.h>
#include <dalembert/solvers/manifold/multiplier_forces.h>

#include <algorithm>
#include <cmath>

namespace dalembert {

namespace {

/// The places of the rows with a multiplier mu: the holonomic ones that are not parallel.
std::vector<std::size_t> rows_with_mu(const ActiveRows& all) {
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < all.holonomic; ++k) {
    if (!std::ranges::binary_search(all.parallel, k)) places.push_back(k);
  }
  return places;
}

std::vector<std::size_t> those_at(const std::vector<std::size_t>& places, const ActiveRows& all) {
  std::vector<std::size_t> rows;
  for (const std::size_t k : places) rows.push_back(all.rows[k]);
  return rows;
}

/// The part of a correction that may be wrong. Near Painleve's point Newton's iteration multiplies it by 1/D,
/// D being what friction leaves of the determinant. From here to 0 a run up to that point takes as many
/// steps.
constexpr double settled = 1e-6;
/// There each repetition leaves the part h/(time to that point); longer steps fail anyway.
constexpr int most_repetitions = 10;

bool any(const std::vector<char>& flags) { return std::ranges::find(flags, 1) != flags.end(); }

}  // namespace

NewtonMatrix::NewtonMatrix(const Problem& problem, const ActiveRows& rows, double time)
    : problem_(problem),
      system_(&problem_.system()),
      rows_(rows),
      time_(time),
      needs_k1_(problem.islands().count, 0),
      stiff_(needs_k1_),
      linear_(system_->linearisation()),
      w_(system_->w_columns().size()),
      lower_(w_.size()),
      s_(system_->rows()),
      with_mu_(rows_with_mu(rows)),
      k2_(problem.pattern(those_at(with_mu_, rows))),
      weakest_(*system_),
      rows_of_k2_{those_at(with_mu_, rows), with_mu_.size()},
      x1_(system_->coordinates() + rows.size()),
      x2_(k2_.size()),
      p_(system_->coordinates()),
      dmu_(rows.holonomic),
      yields_(dmu_.size(), 0),
      first_force_entry_(system_->stiffness_of_constraints()) {
  const System& system = *system_;
  const Islands& islands = problem.islands();
  for (const std::size_t row : rows.rows) {
    if (row >= system.holonomic_rows() || system.law(row).compliant())
      needs_k1_[islands.of_row(system, row)] = 1;
  }
  for (std::size_t k = 0; k < system.forces().friction_pattern().size(); ++k) {
    const auto [coordinate, row] = system.forces().friction_pattern()[k];
    needs_k1_[islands.of_coordinate[coordinate]] = 1;
    const auto active = static_cast<std::size_t>(std::ranges::find(rows.rows, row) - rows.rows.begin());
    if (active < rows.holonomic) friction_.push_back({k, coordinate, active});
  }
  // What forces may need is made before the first step: stepping allocates nothing, but for a scene
  // without them whose multipliers become stiff.
  if (const auto may_need = varying_islands(); any(may_need)) include(may_need);
}

/// Per island, whether it needs K1 or has forces besides constant ones: entries of the stiffness besides
/// the constraints'.
std::vector<char> NewtonMatrix::varying_islands() const {
  auto varying = needs_k1_;
  for (const auto& entry : system_->stiffness_pattern().subspan(first_force_entry_))
    varying[problem_.islands().of_coordinate[entry.row]] = 1;
  return varying;
}

/// Makes the matrix K1 for these islands.
void NewtonMatrix::include(const std::vector<char>& which) {
  const Islands& islands = problem_.islands();
  std::vector<std::size_t> coordinates, rows, active;
  for (std::size_t i = 0; i < system_->coordinates(); ++i) {
    if (which[islands.of_coordinate[i]]) coordinates.push_back(i);
  }
  for (std::size_t k = 0; k < rows_.rows.size(); ++k) {
    if (!which[islands.of_row(*system_, rows_.rows[k])]) continue;
    rows.push_back(rows_.rows[k]);
    active.push_back(k);
  }
  if (k1_) factorisations_of_earlier_ += k1_->matrix.factorisations();
  SaddleMatrix matrix(problem_.pattern(rows, coordinates), SaddleValues::Blocks::all);
  const std::size_t size = matrix.size();
  k1_.emplace(Stiff{std::move(active), which, std::move(matrix), std::vector<double>(size)});
}

/// Finds the islands where H or D are not small, by their largest row sums.
void NewtonMatrix::judge(double c) {
  std::ranges::fill(p_, 0.0);
  const double of_constraints = 1.0 / (c * c), of_forces = std::max(1.0 / (c * c), time_ / c);
  for (std::size_t k = 0; k < linear_.stiffness.size(); ++k) {
    p_[system_->stiffness_pattern()[k].row] +=
        (k < first_force_entry_ ? of_constraints : of_forces) * std::abs(linear_.stiffness[k]);
  }
  for (std::size_t k = 0; k < linear_.damping.size(); ++k)
    p_[system_->forces().damping_pattern()[k].row] += std::abs(linear_.damping[k]) / c;
  std::ranges::fill(stiff_, 0);
  for (std::size_t i = 0; i < p_.size(); ++i) {
    if (p_[i] > still_soft_ * system_->masses()[i]) stiff_[problem_.islands().of_coordinate[i]] = 1;
  }
}

void NewtonMatrix::converged_badly() {
  if (soft()) still_soft_ = 0.0;
}

void NewtonMatrix::leave_out_soft_forces() {
  const auto soft = [this](const MatrixEntry& entry) {
    return !stiff_[problem_.islands().of_coordinate[entry.row]];
  };
  for (std::size_t k = 0; k < linear_.stiffness.size(); ++k)
    if (soft(system_->stiffness_pattern()[k])) linear_.stiffness[k] = 0.0;
  for (std::size_t k = 0; k < linear_.damping.size(); ++k)
    if (soft(system_->forces().damping_pattern()[k])) linear_.damping[k] = 0.0;
}

bool NewtonMatrix::factorise(const Instant& at, const System::Evaluation& e, std::span<const double> lambda,
                             double c) {
  system_->linearise(at, lambda, linear_);
  judge(c);
  std::ranges::copy(e.w, w_.begin());
  if (!k2_.factorise({.w = w_})) return false;
  if (asks_sine_) sine_ = weakest_.smallest_singular_value(k2_, rows_of_k2_, w_, problem_.islands());
  fastest_ = fastest_vibrations(*system_, w_, linear_, p_);
  k1_in_use_ = false;
  for (std::size_t i = 0; i < stiff_.size(); ++i) {
    if (!stiff_[i] && !needs_k1_[i]) continue;
    k1_in_use_ = true;
    if (k1_ && k1_->islands[i]) continue;
    auto all = k1_ ? k1_->islands : needs_k1_;
    std::ranges::transform(all, stiff_, all.begin(), [](char a, char b) { return a | b; });
    include(all);
  }
  if (!k1_in_use_) return true;
  if (!factorise_stiff(c)) return false;
  require_acceleration(c, at.t);
  return true;
}

/// That friction does not turn the sign of the determinant, see MultiplierForceSolver.
void NewtonMatrix::require_acceleration(double c, double t) {
  if (!system_->forces().has_friction() || k1_->matrix.sign_of_determinant() > 0) return;
  std::vector<double> slope(linear_.friction.size(), 0.0);
  slope.swap(linear_.friction);
  const bool turned = factorise_stiff(c) && k1_->matrix.sign_of_determinant() > 0;
  slope.swap(linear_.friction);
  if (turned) refuse_friction(*system_, linear_.friction, t);
  static_cast<void>(factorise_stiff(c));
}

bool NewtonMatrix::factorise_stiff(double c) {
  leave_out_soft_forces();
  std::copy(w_.begin(), w_.end(), lower_.begin());
  for (std::size_t r = system_->holonomic_rows(); r < system_->rows(); ++r) {
    for (const std::size_t k : system_->row(r)) lower_[k] += linear_.psi_q[k] / c;
  }
  for (std::size_t r = 0; r < s_.size(); ++r) s_[r] = c * c * system_->law(r).compliance;
  return k1_->matrix.factorise({.w = w_,
                                .s = s_,
                                .slope = linear_.friction,
                                .lower = lower_,
                                .forces = &linear_,
                                .h = 1.0 / (c * c),
                                .d = 1.0 / c});
}

bool NewtonMatrix::refresh(const System::Evaluation& e, double c) {
  std::ranges::copy(e.w, w_.begin());
  return k2_.factorise({.w = w_}) && (!k1_in_use_ || factorise_stiff(c));
}

/// Of an active row, from what (5) and (6) gave for it.
double NewtonMatrix::dlambda(std::size_t active, double c) const {
  const double unknown = x1_[system_->coordinates() + active];
  const bool with_dmu = active < dmu_.size() && !yields_[active];
  return with_dmu ? unknown - c * dmu_[active] : unknown;
}

/// The matrix of (5) and (6) where forces are soft: of x1_, what belongs to islands without parallel rows.
void NewtonMatrix::solve_by_k2() {
  const auto n = system_->coordinates();
  std::copy_n(x1_.begin(), n, x2_.begin());
  for (std::size_t j = 0; j < with_mu_.size(); ++j) x2_[n + j] = x1_[n + with_mu_[j]];
  k2_.solve(x2_);
  std::copy_n(x2_.begin(), n, x1_.begin());
  for (std::size_t j = 0; j < with_mu_.size(); ++j) x1_[n + with_mu_[j]] = x2_[n + j];
}

/// (5) to (7), given p and dmu as far as they are known; leaves x, dnu in x1_, dv in x2_, and dmu.
void NewtonMatrix::eliminate(double c, std::span<const double> b) {
  const auto n = system_->coordinates();
  const auto m = rows_.size();
  const auto m_holonomic = rows_.holonomic;
  const auto b1 = b.subspan(0, n);
  const auto b2 = b.subspan(n, n);
  const auto b3 = b.subspan(2 * n, m);
  const auto b4 = b.subspan(2 * n + m, m_holonomic);
  const auto C = [&](std::size_t row) { return system_->law(row).compliance; };

  // (5), (6)
  for (std::size_t i = 0; i < n; ++i) x1_[i] = -b2[i] - c * b1[i];
  if (k1_in_use_) {
    for (std::size_t k = 0; k < linear_.damping.size(); ++k) {
      const auto [row, column] = system_->forces().damping_pattern()[k];
      x1_[row] += linear_.damping[k] * p_[column];
    }
  }
  for (const Friction& f : friction_) {
    if (!yields_[f.active]) x1_[f.coordinate] -= c * linear_.friction[f.entry] * dmu_[f.active];
  }
  for (std::size_t r = 0; r < m; ++r) {
    const auto row = rows_.rows[r];
    if (r >= m_holonomic) {
      x1_[n + r] = c * (b3[r] - row_times(*system_, w_, row, p_));
    } else if (yields_[r]) {
      x1_[n + r] = c * c * b4[r];
      add_row(*system_, w_, row, c * dmu_[r], x1_);
    } else {
      x1_[n + r] = c * c * (b4[r] + c * C(row) * dmu_[r]);
    }
  }
  if (k1_in_use_) {
    std::size_t next = 0;
    for (const std::size_t i : k1_->matrix.coordinates()) k1_->x[next++] = x1_[i];
    for (const std::size_t r : k1_->active) k1_->x[next++] = x1_[n + r];
    k1_->matrix.solve(k1_->x);
  }
  if (!k1_in_use_ || k1_->matrix.coordinates().size() < n) solve_by_k2();
  if (k1_in_use_) {
    std::size_t next = 0;
    for (const std::size_t i : k1_->matrix.coordinates()) x1_[i] = k1_->x[next++];
    for (const std::size_t r : k1_->active) x1_[n + r] = k1_->x[next++];
  }

  // (7)
  const auto masses = system_->masses();
  for (std::size_t i = 0; i < n; ++i) {
    x2_[i] = b1[i] + masses[i] * x1_[i] / c;
    x1_[i] /= c * c;
  }
  for (std::size_t j = 0; j < with_mu_.size(); ++j) {
    const std::size_t r = with_mu_[j];
    const auto row = rows_.rows[r];
    x2_[n + j] = b3[r] - row_times(*system_, linear_.psi_q, row, x1_) - c * C(row) * dlambda(r, c);
  }
  k2_.solve(x2_);
  for (std::size_t j = 0; j < with_mu_.size(); ++j) dmu_[with_mu_[j]] = -x2_[n + j];  // the matrix has -G^T
}

void NewtonMatrix::eliminate_again(double c, std::span<const double> b) {
  for (std::size_t i = 0; i < p_.size(); ++i) p_[i] = x2_[i] - c * x1_[i];
  eliminate(c, b);
}

/// Eliminates again until the dlambda that friction reads are settled. They depend on dmu linearly, so what
/// the next time would change is to the last change as the changes of dmu are.
void NewtonMatrix::settle_friction(double c, std::span<const double> b) {
  const auto read = [&](Friction& f) { f.dmu = dmu_[f.active], f.dlambda = dlambda(f.active, c); };
  double last = 0.0;
  for (Friction& f : friction_) last = std::max(last, std::abs(dmu_[f.active]));
  for (int more = most_repetitions; more > 0; --more) {
    std::ranges::for_each(friction_, read);
    eliminate_again(c, b);
    double of_mu = 0.0, of_lambda = 0.0, size = 0.0;
    for (const Friction& f : friction_) {
      of_mu = std::max(of_mu, std::abs(dmu_[f.active] - f.dmu));
      of_lambda = std::max(of_lambda, std::abs(dlambda(f.active, c) - f.dlambda));
      size = std::max(size, std::abs(dlambda(f.active, c)));
    }
    if (of_lambda * of_mu <= settled * size * last) return;
    last = of_mu;
  }
}

/// How often to eliminate again with the dmu of the last time, where no friction asks for more.
int NewtonMatrix::repetitions() const {
  if (!k1_in_use_) return 0;
  if (system_->compliant()) return 2;
  const bool nonholonomic = rows_.holonomic < rows_.size();
  const bool dmu_matters = nonholonomic || !linear_.damping.empty();
  return rows_.holonomic > 0 && dmu_matters ? 1 : 0;
}

void NewtonMatrix::solve(double c, std::span<double> b) {
  const auto n = system_->coordinates();
  const auto m = rows_.size();
  const auto m_holonomic = rows_.holonomic;
  for (std::size_t i = 0; i < n; ++i) p_[i] = b[i] / system_->masses()[i];
  std::ranges::fill(dmu_, 0.0);
  for (std::size_t r = 0; r < m_holonomic && system_->compliant(); ++r) {
    const auto row = rows_.rows[r];
    yields_[r] = c * c * system_->law(row).compliance > inverse_effective_mass(*system_, w_, row);
  }
  eliminate(c, b);
  for (int more = repetitions(); more > 0; --more) eliminate_again(c, b);
  if (!friction_.empty()) settle_friction(c, b);

  std::copy_n(x1_.begin(), n, b.begin());
  std::copy_n(x2_.begin(), n, b.begin() + static_cast<std::ptrdiff_t>(n));
  for (std::size_t r = 0; r < m; ++r) {
    b[2 * n + r] = dlambda(r, c);
    if (r < m_holonomic) b[2 * n + m + r] = dmu_[r];
  }
}

std::string NewtonMatrix::method() const {
  if (!k1_in_use_) return k2_.method();
  const auto by_k1 = static_cast<std::size_t>(std::ranges::count(k1_->islands, 1));
  if (by_k1 == stiff_.size()) return "KLU";
  return "KLU for " + std::to_string(by_k1) + " of " + std::to_string(stiff_.size()) + " islands, " +
         k2_.method() + " for the others";
}

}  // namespace dalembert
