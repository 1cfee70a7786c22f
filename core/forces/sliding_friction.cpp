#include "dalembert/core/forces/sliding_friction.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

struct SlidingFriction::Room {
  std::vector<double> psi, w, psi_q, stiffness, sigma;  // of the whole batch
  std::vector<double> d, f;                             // of one
  double speed = 0.0;                                   // |u + s d0|

  /// Kept from call to call for its memory alone.
  static Room& spare() {
    thread_local Room kept;
    return kept;
  }
};

/// Of one call: two threads may read one run, and the equation of a slip velocity another run.
struct SlidingFriction::Work : Room {
  Work() : Room(std::exchange(spare(), {})) {}
  ~Work() { spare() = std::move(static_cast<Room&>(*this)); }
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;
};

SlidingFriction::SlidingFriction(std::shared_ptr<const ConstraintBatch> of, std::vector<Sliding> sliding)
    : batch_(std::move(of)),
      sliding_(std::move(sliding)),
      rows_(static_cast<std::size_t>(batch_->shape().rows)),
      width_(static_cast<std::size_t>(batch_->shape().width)) {
  not_sliding_.assign(batch_->size() * rows_, 1);
  for (const Sliding& s : sliding_) {
    std::fill_n(not_sliding_.begin() + static_cast<std::ptrdiff_t>(s.element * rows_), rows_, char{0});
    const auto own = batch_->coordinates().subspan(s.element * width_, width_);
    coordinates_.insert(coordinates_.end(), own.begin(), own.end());
    pressed_by_.push_back(s.pressed_by);
  }
}

std::unique_ptr<ForceBatch> SlidingFriction::clone() const {
  return std::make_unique<SlidingFriction>(*this);
}

ForceShape SlidingFriction::shape() const {
  return {batch_->shape().kind, static_cast<int>(width_), 1, true, false, batch_->shape().timed};
}

void SlidingFriction::evaluate(const Instant& at, Work& work) const try {
  work.psi.resize(batch_->size() * rows_);
  work.w.resize(work.psi.size() * width_);
  work.d.resize(rows_);
  work.f.resize(width_);
  batch_->evaluate(at, {{}, work.psi, work.w}, not_sliding_);
} catch (const ElementFault& fault) {
  const auto own = std::ranges::find(sliding_, fault.element, &Sliding::element);
  throw ElementFault{static_cast<std::size_t>(own - sliding_.begin()), fault.what};
}

void SlidingFriction::find_direction(std::size_t i, Work& work) const {
  const Sliding& s = sliding_[i];
  if (rows_ == 1) {
    work.d[0] = s.direction[0];
    return;
  }
  double square = 0.0;
  for (std::size_t k = 0; k < rows_; ++k) {
    work.d[k] = work.psi[s.element * rows_ + k] + s.slow * s.direction[k];
    square += work.d[k] * work.d[k];
  }
  work.speed = std::sqrt(square);
  for (double& x : work.d) x /= work.speed;
}

void SlidingFriction::find_force_per_lambda(std::size_t i, Work& work) const {
  find_direction(i, work);
  const double* const w = work.w.data() + sliding_[i].element * rows_ * width_;
  std::ranges::fill(work.f, 0.0);
  for (std::size_t k = 0; k < rows_; ++k) {
    for (std::size_t j = 0; j < width_; ++j)
      work.f[j] -= sliding_[i].strength * work.d[k] * w[k * width_ + j];
  }
}

void SlidingFriction::add_force(const Instant& at, const Multipliers& lambda, std::span<double> F) const {
  Work work;
  evaluate(at, work);
  for (std::size_t i = 0; i < sliding_.size(); ++i) {
    find_force_per_lambda(i, work);
    const double pressing = lambda.all[lambda.first_row[i]];
    for (std::size_t j = 0; j < width_; ++j)
      F[static_cast<std::size_t>(coordinates_[i * width_ + j])] += pressing * work.f[j];
  }
}

void SlidingFriction::slope(const Instant& at, const Multipliers& /*lambda*/, std::span<double> out) const {
  Work work;
  evaluate(at, work);
  for (std::size_t i = 0; i < sliding_.size(); ++i) {
    find_force_per_lambda(i, work);
    std::ranges::copy(work.f, out.begin() + static_cast<std::ptrdiff_t>(i * width_));
  }
}

/// With P = (1 - d d^T)/|u + s d0|, of one slip velocity 0:
///
///   dF/dq = d(W^T sigma)/dq - mu |lambda| W^T P u_q,   dF/dv = -mu |lambda| W^T P W
void SlidingFriction::linearise(const Instant& at, const Multipliers& lambda, std::span<double> stiffness,
                                std::span<double> damping) const {
  Work work;
  evaluate(at, work);
  work.sigma.assign(work.psi.size(), 0.0);
  work.psi_q.resize(work.w.size());
  work.stiffness.resize(batch_->size() * width_ * width_);
  for (std::size_t i = 0; i < sliding_.size(); ++i) {
    find_direction(i, work);
    const double pressure = sliding_[i].strength * lambda.all[lambda.first_row[i]];
    for (std::size_t k = 0; k < rows_; ++k)
      work.sigma[sliding_[i].element * rows_ + k] = -pressure * work.d[k];
  }
  batch_->linearise(at, work.sigma, work.psi_q, work.stiffness, not_sliding_);
  for (std::size_t i = 0; i < sliding_.size(); ++i) {
    const std::size_t block = width_ * width_, element = sliding_[i].element;
    const auto own = stiffness.subspan(i * block, block), own_damping = damping.subspan(i * block, block);
    std::copy_n(work.stiffness.begin() + static_cast<std::ptrdiff_t>(element * block), block, own.begin());
    std::ranges::fill(own_damping, 0.0);
    if (rows_ == 1) continue;
    find_direction(i, work);
    const double pressure = sliding_[i].strength * lambda.all[lambda.first_row[i]];
    const double* const w = work.w.data() + element * rows_ * width_;
    const double* const u_q = work.psi_q.data() + element * rows_ * width_;
    for (std::size_t k = 0; k < rows_; ++k) {
      for (std::size_t l = 0; l < rows_; ++l) {
        const double c = -pressure * ((k == l ? 1.0 : 0.0) - work.d[k] * work.d[l]) / work.speed;
        for (std::size_t a = 0; a < width_; ++a) {
          for (std::size_t b = 0; b < width_; ++b) {
            own[a * width_ + b] += c * w[k * width_ + a] * u_q[l * width_ + b];
            own_damping[a * width_ + b] += c * w[k * width_ + a] * w[l * width_ + b];
          }
        }
      }
    }
  }
}

void SlidingFriction::power(const Instant& at, const Multipliers& lambda, std::span<double> out) const {
  Work work;
  evaluate(at, work);
  for (std::size_t i = 0; i < sliding_.size(); ++i) {
    find_force_per_lambda(i, work);
    out[i] = 0.0;
    for (std::size_t j = 0; j < width_; ++j)
      out[i] += lambda.all[lambda.first_row[i]] * work.f[j] *
                at.v[static_cast<std::size_t>(coordinates_[i * width_ + j])];
  }
}

void SlidingFriction::force(std::size_t element, const Instant& at, std::span<const double> lambda,
                            std::span<double> out) const {
  Work work;
  evaluate(at, work);
  find_force_per_lambda(element, work);
  for (std::size_t j = 0; j < width_; ++j) out[j] = lambda[0] * work.f[j];
}

void SlidingFriction::exert(const Instant& at, std::span<const std::size_t> first_row,
                            std::span<double> lambda, std::span<double> slots) const {
  Work work;
  evaluate(at, work);
  for (std::size_t i = 0; i < sliding_.size(); ++i) {
    find_force_per_lambda(i, work);
    const double pressing = lambda[first_row[i]];
    const auto sigma = sliding_[i].rows.in(lambda), F = sliding_[i].slots.in(slots);
    for (std::size_t j = 0; j < width_; ++j) F[j] = pressing * work.f[j];
    for (std::size_t k = 0; k < rows_; ++k) sigma[k] = -sliding_[i].strength * pressing * work.d[k];
  }
}

}  // namespace dalembert
