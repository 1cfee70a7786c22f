#include "dalembert/core/equations/batch.h"

namespace dalembert {

namespace {

/// Calls f(first, end) for ranges of elements, of so many rows each, that are all in force.
template <class F>
void for_those_in_force(std::size_t size, std::size_t rows, std::span<const char> out_of_force, const F& f) {
  if (out_of_force.empty()) return f(std::size_t{0}, size);
  for (std::size_t i = 0; i < size;) {
    std::size_t end = i;
    while (end < size && !out_of_force[end * rows]) ++end;
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

void ConstraintBatch::evaluate_those_in_force(const Instant& at, const ConstraintValues& out,
                                              std::span<const char> out_of_force) const {
  const auto rows = static_cast<std::size_t>(type_->equation.rows),
             width = static_cast<std::size_t>(type_->equation.elements.coordinates);
  for_those_in_force(size(), rows, out_of_force, [&](std::size_t first, std::size_t end) {
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

void ConstraintBatch::bias(const Instant& at, std::span<double> gamma,
                           std::span<const char> out_of_force) const {
  evaluate(at, {.g = {}, .psi = {}, .w = {}, .gamma = gamma}, out_of_force);
}

void ConstraintBatch::linearise(const Instant& at, std::span<const double> lambda, std::span<double> psi_q,
                                std::span<double> stiffness, std::span<const char> out_of_force) const {
  const auto rows = static_cast<std::size_t>(type_->equation.rows),
             width = static_cast<std::size_t>(type_->equation.elements.coordinates);
  for_those_in_force(size(), rows, out_of_force, [&](std::size_t first, std::size_t end) {
    equations_.linearise(at, first, end, lambda.data() + first * rows, psi_q.data() + first * rows * width,
                         stiffness.data() + first * width * width);
  });
}

void ConstraintBatch::gaps(const Instant& at, std::span<double> g, std::span<double> rate) const {
  if (type_->conditional) equations_.evaluate(at, 0, size(), {.g = g, .psi = rate});
}

}  // namespace dalembert
