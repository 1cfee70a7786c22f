#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/errors.h>
#include <dalembert/core/scene/system.h>

#include <algorithm>

namespace dalembert {

void System::place_frictions(const Layout& layout) {
  for (std::size_t b = friction_places_.size(); b < parts_.frictions.size(); ++b) {
    const auto& batch = parts_.frictions[b];
    const MultiplierForceShape shape = batch->shape();
    const auto width = static_cast<std::size_t>(shape.width);
    const auto rows = static_cast<std::size_t>(shape.rows);
    FrictionPlace place{friction_pattern_.size(),     stiffness_pattern_.size(),     damping_pattern_.size(),
                        batch->size() * rows * width, batch->size() * width * width, {}};
    append_blocks(batch->coordinates(), width, stiffness_pattern_);
    append_blocks(batch->coordinates(), width, damping_pattern_);
    for (std::size_t i = 0; i < batch->size(); ++i) {
      const auto constraint = static_cast<std::size_t>(batch->constraints()[i]);
      const auto first_row = static_cast<std::size_t>(layout.constraints[constraint].first_row);
      place.first_row.push_back(first_row);
      for (std::size_t r = 0; r < rows; ++r) {
        for (const int coordinate : batch->coordinates().subspan(i * width, width))
          friction_pattern_.push_back({static_cast<std::size_t>(coordinate), first_row + r});
      }
    }
    friction_places_.push_back(std::move(place));
  }
}

std::string System::friction_label(std::size_t batch, std::size_t element) const {
  const auto number = static_cast<std::size_t>(parts_.friction_numbers[batch][element]);
  return batch < stated_frictions_ ? layout_->forces[number].label() : layout_->constraints[number].label();
}

template <class F>
void System::on_frictions(const Instant& at, std::span<const double> lambda, const F& f) const {
  for (std::size_t b = 0; b < parts_.frictions.size(); ++b) {
    const FrictionPlace& place = friction_places_[b];
    try {
      Branches::begin_batch(parts_.constraints.size() + parts_.forces.size() + b);
      f(*parts_.frictions[b], Multipliers{lambda, place.first_row}, place);
    } catch (const ElementFault& fault) {
      throw EquationFault(friction_label(b, fault.element) + ' ' + fault.what + at_time(at.t));
    }
  }
}

void System::add_friction(const Instant& at, std::span<const double> lambda, std::span<double> F) const {
  on_frictions(at, lambda,
               [&](const MultiplierForceBatch& batch, const Multipliers& read, const FrictionPlace&) {
                 batch.add_force(at, read, F);
               });
}

void System::friction_slope(const Instant& at, std::span<const double> lambda, std::span<double> out) const {
  on_frictions(at, lambda,
               [&](const MultiplierForceBatch& batch, const Multipliers& read, const FrictionPlace& place) {
                 batch.slope(at, read, out.subspan(place.slope, place.slope_count));
               });
}

void System::linearise_frictions(const Instant& at, std::span<const double> lambda,
                                 Linearisation& out) const {
  on_frictions(at, lambda,
               [&](const MultiplierForceBatch& batch, const Multipliers& read, const FrictionPlace& place) {
                 batch.slope(at, read, std::span(out.friction).subspan(place.slope, place.slope_count));
                 batch.linearise(at, read,
                                 std::span(out.stiffness).subspan(place.stiffness, place.block_count),
                                 std::span(out.damping).subspan(place.damping, place.block_count));
               });
}

std::string System::label_of_batch(std::size_t batch) const {
  const auto of = [](std::size_t size, auto label, std::string_view kind) {
    return size == 1 ? label() : "one of the " + std::to_string(size) + ' ' + std::string(kind);
  };
  if (batch < parts_.constraints.size()) {
    const auto& constraints = *parts_.constraints[batch];
    const auto first = static_cast<std::size_t>(parts_.constraint_numbers[batch].front());
    return of(
        constraints.size(), [&] { return layout_->constraints[first].label(); }, constraints.shape().kind);
  }
  batch -= parts_.constraints.size();
  if (batch < parts_.forces.size()) {
    const auto& forces = *parts_.forces[batch];
    return of(
        forces.size(), [&] { return force_label(batch, 0); }, forces.shape().kind);
  }
  batch -= parts_.forces.size();
  const auto& frictions = *parts_.frictions[batch];
  return of(
      frictions.size(), [&] { return friction_label(batch, 0); }, frictions.shape().kind);
}

std::string System::force_of_friction(std::size_t entry) const {
  const auto next = std::ranges::upper_bound(friction_places_, entry, {}, &FrictionPlace::slope);
  const auto batch = static_cast<std::size_t>(next - friction_places_.begin()) - 1;
  const MultiplierForceShape shape = parts_.frictions[batch]->shape();
  return friction_label(
      batch, (entry - friction_places_[batch].slope) / static_cast<std::size_t>(shape.width * shape.rows));
}

std::string System::friction_of_stiffness(std::size_t entry) const {
  const auto next = std::ranges::upper_bound(friction_places_, entry, {}, &FrictionPlace::stiffness);
  const auto batch = static_cast<std::size_t>(next - friction_places_.begin()) - 1;
  const int width = parts_.frictions[batch]->shape().width;
  return friction_label(
      batch, (entry - friction_places_[batch].stiffness) / static_cast<std::size_t>(width * width));
}

}  // namespace dalembert
