#include "dalembert/core/equations/batch.h"

namespace dalembert {

namespace {

/// Calls f(first, end) for stretches of elements of which none is left out.
template <class F>
void for_those_in_force(std::size_t size, std::span<const char> left_out, const F& f) {
  if (left_out.empty()) return f(std::size_t{0}, size);
  for (std::size_t i = 0; i < size;) {
    std::size_t end = i;
    while (end < size && !left_out[end]) ++end;
    if (end > i) f(i, end);
    i = end + 1;
  }
}

}  // namespace

std::unique_ptr<ConstraintBatch> ConstraintBatch::clone() const {
  return std::make_unique<ConstraintBatch>(*this);
}

ConstraintShape ConstraintBatch::shape() const {
  const detail::EquationType& its = type_->equation;
  return {type_->kind,         its.rows,        its.elements.coordinates,
          its.elements.inputs, type_->internal, !its.on_velocities,
          type_->timed,        its.singular};
}

void ConstraintBatch::evaluate(const Instant& at, const ConstraintValues& out) const {
  const auto rows = static_cast<std::size_t>(type_->equation.rows),
             width = static_cast<std::size_t>(type_->equation.elements.coordinates);
  for_those_in_force(size(), left_out_, [&](std::size_t first, std::size_t end) {
    const auto part = [](std::span<double> all, std::size_t from) {
      return all.empty() ? all : all.subspan(from);
    };
    const std::size_t row = first * rows;
    equations_.evaluate(
        at, first, end,
        {part(out.g, row), part(out.psi, row), part(out.w, row * width), part(out.gamma, row)});
  });
}

void ConstraintBatch::forces_at_points(std::span<const double> w, std::span<const double> lengths,
                                       std::span<double> out) const {
  equations_.elements().forces_at_points(type_->equation.rows, w, lengths, out);
}

void ConstraintBatch::laws(std::span<RowLaw> out) const {
  if (type_->compliance == nullptr) return;
  for (std::size_t row = 0; row < out.size(); ++row)
    out[row] = {
        type_->compliance(equations_.elements()[row / static_cast<std::size_t>(type_->equation.rows)])};
}

void ConstraintBatch::bias(const Instant& at, std::span<double> gamma) const {
  evaluate(at, {.g = {}, .psi = {}, .w = {}, .gamma = gamma});
}

void ConstraintBatch::linearise(const Instant& at, std::span<const double> lambda, std::span<double> psi_q,
                                std::span<double> stiffness) const {
  const auto rows = static_cast<std::size_t>(type_->equation.rows),
             width = static_cast<std::size_t>(type_->equation.elements.coordinates);
  for_those_in_force(size(), left_out_, [&](std::size_t first, std::size_t end) {
    equations_.linearise(at, first, end, lambda.data() + first * rows, psi_q.data() + first * rows * width,
                         stiffness.data() + first * width * width);
  });
}

void ConstraintBatch::gaps(const Instant& at, std::span<double> g, std::span<double> rate) const {
  if (type_->conditional) equations_.evaluate(at, 0, size(), {.g = g, .psi = rate});
}

void ConstraintBatch::leave_out(std::size_t element, bool out) {
  left_out_.resize(size());
  left_out_[element] = out;
}

}  // namespace dalembert
