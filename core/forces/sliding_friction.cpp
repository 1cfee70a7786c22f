#include "dalembert/core/forces/sliding_friction.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

SlidingFriction::SlidingFriction(const detail::Owned<ConstraintBatch>& of, std::vector<Sliding> sliding)
    : batch_(of),
      sliding_(std::move(sliding)),
      rows_(static_cast<std::size_t>(of->shape().rows)),
      width_(static_cast<std::size_t>(of->shape().width)),
      psi_(of->size() * rows_),
      w_(psi_.size() * width_),
      psi_q_(w_.size()),
      stiffness_(of->size() * width_ * width_),
      sigma_(psi_.size()),
      d_(rows_),
      f_(width_) {
  for (std::size_t i = 0; i < of->size(); ++i) (*batch_).leave_out(i);
  for (const Sliding& s : sliding_) {
    (*batch_).leave_out(s.element, false);
    const auto own = of->coordinates().subspan(s.element * width_, width_);
    coordinates_.insert(coordinates_.end(), own.begin(), own.end());
    pressed_by_.push_back(s.pressed_by);
  }
}

ForceShape SlidingFriction::shape() const {
  return {batch_->shape().kind, static_cast<int>(width_), 1, true, false};
}

void SlidingFriction::evaluate(const Instant& at) const try {
  batch_->evaluate(at, {{}, psi_, w_});
} catch (const ElementFault& fault) {
  const auto own = std::ranges::find(sliding_, fault.element, &Sliding::element);
  throw ElementFault{static_cast<std::size_t>(own - sliding_.begin()), fault.what};
}

void SlidingFriction::find_direction(std::size_t i) const {
  const Sliding& s = sliding_[i];
  if (rows_ == 1) {
    d_[0] = s.direction[0];
    return;
  }
  double square = 0.0;
  for (std::size_t k = 0; k < rows_; ++k) {
    d_[k] = psi_[s.element * rows_ + k] + s.slow * s.direction[k];
    square += d_[k] * d_[k];
  }
  speed_ = std::sqrt(square);
  for (double& x : d_) x /= speed_;
}

void SlidingFriction::find_force_per_lambda(std::size_t i) const {
  find_direction(i);
  const double* const w = w_.data() + sliding_[i].element * rows_ * width_;
  std::ranges::fill(f_, 0.0);
  for (std::size_t k = 0; k < rows_; ++k) {
    for (std::size_t j = 0; j < width_; ++j) f_[j] -= sliding_[i].strength * d_[k] * w[k * width_ + j];
  }
}

void SlidingFriction::add_force(const Instant& at, const Multipliers& lambda, std::span<double> F) const {
  evaluate(at);
  for (std::size_t i = 0; i < sliding_.size(); ++i) {
    find_force_per_lambda(i);
    const double pressing = lambda.all[lambda.first_row[i]];
    for (std::size_t j = 0; j < width_; ++j)
      F[static_cast<std::size_t>(coordinates_[i * width_ + j])] += pressing * f_[j];
  }
}

void SlidingFriction::slope(const Instant& at, const Multipliers& /*lambda*/, std::span<double> out) const {
  evaluate(at);
  for (std::size_t i = 0; i < sliding_.size(); ++i) {
    find_force_per_lambda(i);
    std::ranges::copy(f_, out.begin() + static_cast<std::ptrdiff_t>(i * width_));
  }
}

/// With P = (1 - d d^T)/|u + s d0|, of one slip velocity 0:
///
///   dF/dq = d(W^T sigma)/dq - mu |lambda| W^T P u_q,   dF/dv = -mu |lambda| W^T P W
void SlidingFriction::linearise(const Instant& at, const Multipliers& lambda, std::span<double> stiffness,
                                std::span<double> damping) const {
  evaluate(at);
  std::ranges::fill(sigma_, 0.0);
  for (std::size_t i = 0; i < sliding_.size(); ++i) {
    find_direction(i);
    const double pressure = sliding_[i].strength * lambda.all[lambda.first_row[i]];
    for (std::size_t k = 0; k < rows_; ++k) sigma_[sliding_[i].element * rows_ + k] = -pressure * d_[k];
  }
  batch_->linearise(at, sigma_, psi_q_, stiffness_);
  for (std::size_t i = 0; i < sliding_.size(); ++i) {
    const std::size_t block = width_ * width_, element = sliding_[i].element;
    const auto own = stiffness.subspan(i * block, block), own_damping = damping.subspan(i * block, block);
    std::copy_n(stiffness_.begin() + static_cast<std::ptrdiff_t>(element * block), block, own.begin());
    std::ranges::fill(own_damping, 0.0);
    if (rows_ == 1) continue;
    find_direction(i);
    const double pressure = sliding_[i].strength * lambda.all[lambda.first_row[i]];
    const double* const w = w_.data() + element * rows_ * width_;
    const double* const u_q = psi_q_.data() + element * rows_ * width_;
    for (std::size_t k = 0; k < rows_; ++k) {
      for (std::size_t l = 0; l < rows_; ++l) {
        const double c = -pressure * ((k == l ? 1.0 : 0.0) - d_[k] * d_[l]) / speed_;
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
  evaluate(at);
  for (std::size_t i = 0; i < sliding_.size(); ++i) {
    find_force_per_lambda(i);
    out[i] = 0.0;
    for (std::size_t j = 0; j < width_; ++j)
      out[i] += lambda.all[lambda.first_row[i]] * f_[j] *
                at.v[static_cast<std::size_t>(coordinates_[i * width_ + j])];
  }
}

void SlidingFriction::force(std::size_t element, const Instant& at, std::span<const double> lambda,
                            std::span<double> out) const {
  evaluate(at);
  find_force_per_lambda(element);
  for (std::size_t j = 0; j < width_; ++j) out[j] = lambda[0] * f_[j];
}

void SlidingFriction::exert(std::size_t i, const Instant& at, double lambda, std::span<double> sigma,
                            std::span<double> F) const {
  force(i, at, std::span(&lambda, 1), F);
  for (std::size_t k = 0; k < rows_; ++k) sigma[k] = -sliding_[i].strength * lambda * d_[k];
}

}  // namespace dalembert
