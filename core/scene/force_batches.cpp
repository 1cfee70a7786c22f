#include "dalembert/core/scene/force_batches.h"

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/errors.h>

#include <algorithm>
#include <numeric>

namespace dalembert {

ForceBatches::ForceBatches(ForceParts parts, std::shared_ptr<const Layout> layout, std::size_t first_batch,
                           std::vector<MatrixEntry>& stiffness)
    : parts_(std::move(parts)),
      layout_(std::move(layout)),
      first_batch_(first_batch),
      stated_(parts_.batches.size()) {
  sort();
  place(stiffness);
  stated_friction_entries_ = friction_pattern_.size();
}

void ForceBatches::add_sliding(std::shared_ptr<const SlidingFriction> friction, std::vector<int> constraints,
                               std::vector<MatrixEntry>& stiffness) {
  parts_.batches.push_back(friction);
  parts_.numbers.push_back(std::move(constraints));
  slides_.push_back(std::move(friction));
  place(stiffness);
}

void ForceBatches::sort() {
  std::vector<std::size_t> order(parts_.batches.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto reading = std::stable_partition(order.begin(), order.end(),
                                             [this](std::size_t b) { return batch(b).shape().rows == 0; });
  first_friction_ = static_cast<std::size_t>(reading - order.begin());
  std::vector<std::shared_ptr<const ForceBatch>> batches;
  std::vector<std::vector<int>> numbers;
  for (const std::size_t b : order) {
    batches.push_back(std::move(parts_.batches[b]));
    numbers.push_back(std::move(parts_.numbers[b]));
  }
  parts_.batches = std::move(batches);
  parts_.numbers = std::move(numbers);
}

void ForceBatches::place(std::vector<MatrixEntry>& stiffness) {
  for (std::size_t b = places_.size(); b < parts_.batches.size(); ++b) {
    const ForceShape shape = batch(b).shape();
    const auto width = static_cast<std::size_t>(shape.width), rows = static_cast<std::size_t>(shape.rows);
    const std::size_t blocks = batch(b).size() * width * width;
    Own own{Places::from(friction_pattern_.size(), batch(b).size() * rows * width),
            Places::from(stiffness.size(), blocks),
            Places::from(damping_pattern_.size(), shape.dissipative ? blocks : 0)};
    detail::append_blocks(batch(b).coordinates(), width, stiffness);
    if (shape.dissipative) detail::append_blocks(batch(b).coordinates(), width, damping_pattern_);
    for (std::size_t i = 0; i < batch(b).constraints().size(); ++i) {
      const auto constraint = static_cast<std::size_t>(batch(b).constraints()[i]);
      own.first_row.push_back(layout_->constraints[constraint].own_rows().front());
      for (std::size_t r = 0; r < rows; ++r) {
        for (const int coordinate : batch(b).coordinates().subspan(i * width, width))
          friction_pattern_.push_back({static_cast<std::size_t>(coordinate), own.first_row[i] + r});
      }
    }
    places_.push_back(std::move(own));
  }
}

bool ForceBatches::timed() const {
  return std::ranges::any_of(parts_.batches, [](const auto& batch) { return batch->shape().timed; });
}

template <class F>
void ForceBatches::with_label(std::size_t b, double t, const F& f) const {
  try {
    f();
  } catch (const ElementFault& fault) {
    throw detail::named(fault, label(b, fault.element), t);
  }
}

template <class F>
void ForceBatches::on(std::size_t from, std::size_t end, const Instant& at, std::span<const double> lambda,
                      const F& f) const {
  for (std::size_t b = from; b < end; ++b) {
    with_label(b, at.t, [&] {
      Branches::enter_batch(first_batch_ + b);
      f(batch(b), Multipliers{lambda, places_[b].first_row}, places_[b]);
    });
  }
}

void ForceBatches::evaluate(const Instant& at, std::span<double> F) const {
  std::ranges::copy(parts_.constant, F.begin());
  on(0, first_friction_, at, {},
     [&](const ForceBatch& batch, const Multipliers& none, const Own&) { batch.add_force(at, none, F); });
}

void ForceBatches::add_friction(const Instant& at, std::span<const double> lambda,
                                std::span<double> F) const {
  on(first_friction_, parts_.batches.size(), at, lambda,
     [&](const ForceBatch& batch, const Multipliers& read, const Own&) { batch.add_force(at, read, F); });
}

void ForceBatches::friction_slope(const Instant& at, std::span<const double> lambda,
                                  std::span<double> out) const {
  const auto write = [&](const ForceBatch& batch, const Multipliers& read, const Own& own) {
    batch.slope(at, read, own.slope.in(out));
  };
  Branches::or_naturally<EquationFault>(
      [&] { on(first_friction_, parts_.batches.size(), at, lambda, write); });
}

void ForceBatches::linearise(const Instant& at, std::span<const double> lambda, std::span<double> stiffness,
                             std::span<double> damping) const {
  const auto write = [&](const ForceBatch& batch, const Multipliers& read, const Own& own) {
    batch.linearise(at, read, own.stiffness.in(stiffness), own.damping.in(damping));
  };
  Branches::or_naturally<EquationFault>([&] { on(0, parts_.batches.size(), at, lambda, write); });
}

void ForceBatches::exert_sliding(const Instant& at, std::span<double> lambda, std::span<double> slots) const {
  auto next = slides_.begin();
  on(stated_, parts_.batches.size(), at, lambda, [&](const ForceBatch&, const Multipliers& read, const Own&) {
    (*next++)->exert(at, read.first_row, lambda, slots);
  });
}

double ForceBatches::energy(const Instant& at) const {
  double V = -std::inner_product(at.q.begin(), at.q.end(), parts_.constant.begin(), 0.0);
  on(0, first_friction_, at, {},
     [&](const ForceBatch& batch, const Multipliers&, const Own&) { V += batch.energy(at); });
  return V;
}

double ForceBatches::constant_power(std::span<const double> v) const {
  return std::inner_product(v.begin(), v.end(), parts_.constant.begin(), 0.0);
}

void ForceBatches::for_each_power(const Instant& at, std::span<const double> lambda,
                                  const std::function<void(std::string, double)>& f) const {
  for (std::size_t b = 0; b < parts_.batches.size(); ++b) {
    std::vector<double> power(batch(b).size());
    with_label(b, at.t, [&] { batch(b).power(at, {lambda, places_[b].first_row}, power); });
    for (std::size_t i = 0; i < power.size(); ++i) f(label(b, i), power[i]);
  }
}

AppliedForces ForceBatches::applied() const {
  std::vector<AppliedForces::Place> places(layout_->forces.size());
  const auto of = [&places](int number) -> auto& { return places[static_cast<std::size_t>(number)]; };
  for (const auto& [number, acceleration] : parts_.gravities) of(number).acceleration = acceleration;
  for (std::size_t b = 0; b < parts_.batches.size(); ++b) {
    const auto& first_row = places_[b].first_row;
    for (std::size_t i = 0; i < parts_.numbers[b].size(); ++i)
      of(parts_.numbers[b][i]) = {
          .batch = parts_.batches[b], .element = i, .first_row = first_row.empty() ? 0 : first_row[i]};
  }
  return AppliedForces(std::move(places));
}

/// What slides is a constraint.
std::string ForceBatches::label(std::size_t batch, std::size_t element) const {
  const auto number = static_cast<std::size_t>(parts_.numbers[batch][element]);
  return batch < stated_ ? layout_->forces[number].label() : layout_->constraints[number].label();
}

std::string ForceBatches::owner_of(std::size_t entry, Places Own::*array) const {
  const auto owns = [&](const Own& own) { return entry < (own.*array).front() + (own.*array).size(); };
  const auto own = std::ranges::find_if(places_, owns);
  const auto b = static_cast<std::size_t>(own - places_.begin());
  const Places part = *own.*array;
  return label(b, (entry - part.front()) * batch(b).size() / part.size());
}

std::string ForceBatches::owner_of_stiffness(std::size_t entry) const {
  return owner_of(entry, &Own::stiffness);
}
std::string ForceBatches::owner_of_friction(std::size_t entry) const { return owner_of(entry, &Own::slope); }

}  // namespace dalembert
