#include "dalembert/solvers/run/kept_steps.h"

#include <dalembert/core/errors.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/run/chebyshev.h>
#include <dalembert/solvers/run/output_projection.h>
#include <dalembert/solvers/run/segment.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

namespace dalembert {

namespace {

std::string at(double t) {
  std::ostringstream what;
  what.precision(10);
  what << "at(" << t << "): ";
  return what.str();
}

}  // namespace

void KeptSteps::add_segment(const Segment& segment, double t) {
  const Branches::Sides* const held = segment.comparisons.held();
  segments_.push_back({.system = segment.problem.shared_system(),
                       .start = segment.start,
                       .from = t,
                       .first_step = steps_.size(),
                       .sides = held != nullptr ? *held : Branches::Sides{},
                       .begins_to = segment.comparisons.held_to()});
  if (!steps_.empty()) end(t);
  system_ = segments_.back().system;
}

void KeptSteps::end(double t) { steps_.back().end = std::max(t, steps_.back().from); }

void KeptSteps::add(TimeStepper& stepper, double from, long number) {
  const std::size_t n = system_->coordinates(), m = system_->compliant() ? system_->rows() : 0;
  Step step{from, stepper.time(), stepper.time(), number, stepper.degree(), values_.size(), 0.0};
  CompliantMultipliers compliant(m);
  for (int j = 0; j <= step.degree; ++j) {
    const double t = chebyshev_node(step.from, step.to, j, step.degree);
    const std::size_t first = values_.size();
    values_.resize(first + 2 * n);
    const auto q = std::span(values_).subspan(first, n), v = std::span(values_).subspan(first + n, n);
    if (t == segments_.back().from) {
      // Known exactly: the polynomial's rounding would let what rests go backwards.
      std::ranges::copy(segments_.back().start.q, q.begin());
      std::ranges::copy(segments_.back().start.v, v.begin());
    } else {
      stepper.interpolate(t, q, v);
    }
    if (m == 0 || !stepper.compliant_multipliers(t, compliant)) continue;
    step.c = compliant.c;
    for (const auto* part : compliant.parts()) values_.insert(values_.end(), part->begin(), part->end());
  }
  steps_.push_back(step);
}

/// At the time of a change, the one before it; at the start, what goes on behind those there.
const KeptSteps::Step& KeptSteps::step_at(double t) const {
  if (!(t >= steps_.front().from && t <= steps_.back().end)) {
    std::ostringstream what;
    what << at(t) << "must lie within the steps of the run, between " << steps_.front().from << " and "
         << steps_.back().end;
    throw InvalidArgument(what.str());
  }
  if (t > steps_.front().from) return *std::ranges::lower_bound(steps_, t, {}, &Step::end);
  const auto first = std::ranges::upper_bound(steps_, t, {}, &Step::end);
  return first == steps_.end() ? steps_.back() : *first;
}

void KeptSteps::interpolate(const Step& step, double t, OutputState& m,
                            CompliantMultipliers& compliant) const {
  std::vector<std::vector<double>*> parts{&m.q, &m.v};
  compliant.c = step.c;
  if (step.c > 0.0) std::ranges::copy(compliant.parts(), std::back_inserter(parts));
  for (auto* part : parts) std::ranges::fill(*part, 0.0);
  const double* next = values_.data() + step.first;
  for (const double weight : lagrange_polynomials(step.from, step.to, t, step.degree)) {
    for (auto* part : parts) {
      for (double& x : *part) x += weight * *next++;
    }
  }
  m.t = t;
}

const KeptSteps::KeptSegment& KeptSteps::segment_of(const Step& step) const {
  const auto number = static_cast<std::size_t>(&step - steps_.data());
  return *std::prev(std::ranges::upper_bound(segments_, number, {}, &KeptSegment::first_step));
}

void KeptSteps::as_read(double t, const std::function<void()>& f) const {
  const Branches holding(nullptr, segment_of(step_at(t)).held(t));
  f();
}

void KeptSteps::read(std::span<const double> times, Record& out) const {
  CompliantMultipliers compliant(system_->rows());
  const KeptSegment* segment = nullptr;
  std::optional<OutputProjection> output;
  std::optional<OutputState> now;
  for (const double t : times) {
    const Step& step = step_at(t);
    const KeptSegment& own = segment_of(step);
    if (std::exchange(segment, &own) != &own) {
      output.emplace(Problem(own.system), own.start, tolerance_);
      now.emplace(*own.system, own.start);
      out.use_layout(own.system->layout());
    }
    interpolate(step, t, *now, compliant);
    const Branches holding(nullptr, own.held(t));
    try {
      output->read(*now, step.c > 0.0 ? &compliant : nullptr, step.number);
    } catch (const StepFailure& failure) {
      throw EquationFault(at(t) + failure.what);
    }
    out.append(now->flat());
  }
}

}  // namespace dalembert
