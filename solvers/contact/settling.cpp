#include <dalembert/solvers/base/root.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/contact/dry_friction.h>
#include <dalembert/solvers/contact/round_off.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

/// Which rough contacts stick at an instant, and in which direction the others slide.
namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr const char* shares =
    ": its share of the friction is not determined, as others constrain the same slip; state one in place "
    "of all, or end the run before";

}  // namespace

/// u' = W v' + gamma; 0 where it is round-off of its terms, or below the root of the tolerance as forces are.
VectorXd DryFriction::slip_acceleration(const Rough& rough, const Instant& at, const Motion& motion) const {
  auto e = stated_->evaluation();
  std::vector<double> gamma(stated_->rows());
  stated_->evaluate(at, e);
  stated_->bias(at, gamma);
  VectorXd rate(static_cast<Index>(rough.rows));
  double terms = 0.0;
  for (std::size_t k = 0; k < rough.rows; ++k) {
    const std::size_t row = rough.row + k;
    double sum = gamma[row];
    terms = std::max(terms, std::abs(gamma[row]));
    for (const std::size_t j : stated_->row(row)) {
      const double term = e.w[j] * motion.a[stated_->w_columns()[j]];
      const std::size_t i = stated_->w_columns()[j];
      sum += term;
      terms = std::max({terms, std::abs(term), std::abs(e.w[j] * e.force[i] / stated_->masses()[i])});
    }
    rate[static_cast<Index>(k)] = sum;
  }
  if (rate.norm() <= std::sqrt(tolerance_) * terms) rate.setZero();
  return rate;
}

/// When two slip velocities, as slow as the run watches them, come to rest; else now.
double DryFriction::rests_at(const Rough& rough, const Instant& at, std::span<const double> a) const {
  if (rough.mode != Mode::slides || rough.rows == 1) return at.t;
  const VectorXd u = slip(rough), rate = slip_acceleration(rough, at, {{a.begin(), a.end()}, {}});
  const double slows = -u.dot(rate) / u.squaredNorm();
  return slows > 0.0 ? at.t + 1.0 / slows : at.t;
}

/// For two slip velocities that start from rest: d(phi) such that u' is along it.
void DryFriction::find_direction(Rough& rough, const std::vector<std::size_t>& open, const Instant& at) {
  if (rough.rows != 2) return;
  const double first = std::atan2(rough.direction[1], rough.direction[0]);
  const auto across = [&](double phi) {
    rough.direction = Eigen::Vector2d(std::cos(phi), std::sin(phi));
    const VectorXd rate = slip_acceleration(rough, at, solve(open, at));
    return rough.direction[0] * rate[1] - rough.direction[1] * rate[0];
  };
  constexpr double quarter = std::numbers::pi / 2.0;
  const double at_first = across(first);
  if (at_first == 0.0) return;
  const double other = first + std::copysign(quarter, at_first), at_other = across(other);
  if (at_first * at_other > 0.0) refuse(at.t);
  const double phi = root(across, first, at_first, other, at_other, round_off());
  rough.direction = Eigen::Vector2d(std::cos(phi), std::sin(phi));
}

/// The mode to try first: as it was, but for what has changed.
void DryFriction::begin(Rough& rough, const std::vector<std::size_t>& open, std::optional<std::size_t> fallen,
                        const FlatSample& motion) {
  const Mode before = rough.mode;
  if (std::ranges::find(open, rough.pressed_by) != open.end()) {
    rough.mode = Mode::absent;
    return;
  }
  const auto index = static_cast<std::size_t>(&rough - all_.data());
  const bool turned = fallen && *fallen == 2 * index;
  if (fallen && *fallen == 2 * index + 1) rough.sign = -rough.sign;
  const VectorXd u = slip(rough);
  if (before == Mode::sticks && u.norm() <= rough.rest) {
    if (!turned) return;
    require_own_share(rough, motion.unique, motion.time);
    start_sliding(rough, part(rough, motion.lambda));
    return;
  }
  if (turned || (u.norm() <= rough.rest && !(before == Mode::slides && rough.from_rest))) {
    rough.mode = Mode::sticks;
    return;
  }
  if (u.norm() > rough.rest) rough.from_rest = false;
  if (before == Mode::slides) return;
  rough.mode = Mode::slides;
  rough.direction = u.normalized();
  rough.slow = 0.0;
}

/// What starts to slide has less friction than it stuck with: of redundant ones that decides which slides.
void DryFriction::require_own_share(const Rough& rough, std::span<const char> unique, double t) const {
  bool own = unique.empty();
  for (std::size_t k = 0; k < rough.rows && !unique.empty(); ++k) own = unique[rough.row + k] != 0;
  if (own || rough.mu_static == rough.mu) return;
  throw StepFailure{stated_->row_label(rough.row) + shares, t};
}

/// Releases, of what sticks and would exceed its bound, what exceeds it most; whether there is any.
bool DryFriction::release_most_exceeded(const std::vector<std::size_t>& open, const Instant& at,
                                        const Motion& motion) {
  Rough* most = nullptr;
  double by = 1.0 + round_off();
  for (Rough& r : all_) {
    if (r.mode != Mode::sticks) continue;
    const double sigma = part(r, motion.lambda).norm();
    const double ratio = sigma / (r.mu_static * std::abs(motion.lambda[r.pressing_row]));
    if (sigma <= round_off_of(r, motion.a, motion.lambda) || !(ratio > by)) continue;
    most = &r;
    by = ratio;
  }
  if (most == nullptr) return false;
  require_own_share(*most, motion.unique, at.t);
  if (!most->one_sided) most->sign = motion.lambda[most->pressing_row] < 0.0 ? -1.0 : 1.0;
  start_sliding(*most, part(*most, motion.lambda));
  find_direction(*most, open, at);
  return true;
}

/// Whether two slip velocities that start from rest take another direction than they were released in.
bool DryFriction::turn(Rough& rough, const std::vector<std::size_t>& open, const Instant& at,
                       const Motion& motion) {
  if (rough.rows != 2) return false;
  const VectorXd rate = slip_acceleration(rough, at, motion);
  const double across = rough.direction[0] * rate[1] - rough.direction[1] * rate[0];
  if (std::abs(across) <= std::sqrt(round_off()) * rate.norm()) return false;
  find_direction(rough, open, at);
  return true;
}

/// Whether something violated (1) and has been changed.
bool DryFriction::amend(const std::vector<std::size_t>& open, const Instant& at, const Motion& motion) {
  for (Rough& r : all_) {
    const double zero = round_off_of(r, motion.a, motion.lambda);
    if (r.mode != Mode::slides || r.one_sided || r.sign * motion.lambda[r.pressing_row] >= -zero) continue;
    r.sign = -r.sign;
    return true;
  }
  if (release_most_exceeded(open, at, motion)) return true;
  for (Rough& r : all_) {
    if (r.mode != Mode::slides || !r.from_rest || slip(r).norm() > r.rest) continue;
    if (turn(r, open, at, motion)) return true;
    if (r.direction.dot(slip_acceleration(r, at, motion)) >= 0.0) continue;
    r.mode = Mode::sticks;
    return true;
  }
  return false;
}

std::vector<double> DryFriction::modes() const {
  std::vector<double> all;
  for (const Rough& r : all_) {
    all.insert(all.end(), {static_cast<double>(r.mode), r.sign});
    if (r.mode == Mode::slides) all.insert(all.end(), r.direction.begin(), r.direction.end());
  }
  return all;
}

void DryFriction::refuse(double t) const {
  std::string names;
  for (const Rough& r : all_)
    if (r.mode != Mode::absent) names += (names.empty() ? "" : ", ") + stated_->row_label(r.row);
  throw StepFailure{names +
                        ": no motion satisfies Coulomb's law here, neither sticking nor sliding (Painleve's "
                        "paradox); make mu smaller, or end the run before",
                    t};
}

std::vector<DryFriction::Happening> DryFriction::settle(const std::vector<std::size_t>& open,
                                                        const Instant& at, std::optional<std::size_t> fallen,
                                                        const FlatSample& motion) {
  const auto before = all_;
  find_slip(at);
  const double time = fallen ? rests_at(all_[*fallen / 2], at, motion.a) : at.t;
  for (Rough& r : all_) begin(r, open, fallen, motion);
  if (fallen && *fallen % 2 == 0 && all_[*fallen / 2].mode == Mode::slides)
    find_direction(all_[*fallen / 2], open, at);
  std::set<std::vector<double>> tried;
  do {
    if (!tried.insert(modes()).second) refuse(at.t);
  } while (amend(open, at, solve(open, at)));
  system_ = with_modes(open);
  std::vector<Happening> what;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    const Mode was = before[i].mode, is = all_[i].mode;
    const bool turned = was == Mode::slides && is == Mode::slides && fallen == 2 * i;
    if (was == Mode::absent || is == Mode::absent || (was == is && !turned)) continue;
    what.push_back({all_[i].number, is == Mode::sticks ? Happened::sticks : Happened::slides,
                    fallen && *fallen / 2 == i ? time : at.t});
  }
  return what;
}

}  // namespace dalembert
