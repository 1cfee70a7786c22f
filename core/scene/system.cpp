#include "dalembert/core/scene/system.h"

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/errors.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace dalembert {

System::System(SystemParts parts) : parts_(std::move(parts)) {
  const auto layout = std::make_shared<Layout>(std::move(parts_.layout));
  place_constraints(*layout);
  layout->index_slots(coordinates());
  stiffness_of_constraints_ = stiffness_pattern_.size();
  forces_ = ForceBatches(std::move(parts_.forces), layout, parts_.constraints.size(), stiffness_pattern_);
  layout->applied = std::make_shared<const AppliedForces>(forces_.applied());
  layout_ = layout;
}

void System::place_constraints(Layout& layout) {
  auto& batches = parts_.constraints;
  // Holonomic rows first: sort the batches, and with them the numbers of their elements.
  std::vector<std::size_t> order(batches.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t b) { return batches[b]->shape().holonomic; });
  std::vector<std::shared_ptr<const ConstraintBatch>> sorted;
  std::vector<std::vector<int>> numbers;
  for (const std::size_t b : order) {
    sorted.push_back(std::move(batches[b]));
    numbers.push_back(std::move(parts_.constraint_numbers[b]));
  }
  batches = std::move(sorted);
  parts_.constraint_numbers = std::move(numbers);

  row_start_.push_back(0);
  auto& slots = layout.slot_coordinate;
  for (std::size_t b = 0; b < batches.size(); ++b) {
    const ConstraintShape shape = batches[b]->shape();
    const auto width = static_cast<std::size_t>(shape.width);
    const auto coordinates = batches[b]->coordinates();
    const std::size_t row_count = batches[b]->size() * static_cast<std::size_t>(shape.rows);
    constraint_places_.push_back(
        {Places::from(row_start_.size() - 1, row_count), Places::from(w_columns_.size(), row_count * width),
         Places::from(stiffness_pattern_.size(), batches[b]->size() * width * width), shape.holonomic});
    detail::append_blocks(coordinates, width, stiffness_pattern_);
    for (std::size_t i = 0; i < batches[b]->size(); ++i) {
      auto& info = layout.constraints[static_cast<std::size_t>(parts_.constraint_numbers[b][i])];
      info.first_row = static_cast<int>(rows());
      info.first_slot = static_cast<int>(slots.size());
      const auto own = coordinates.subspan(i * width, width);
      slots.insert(slots.end(), own.begin(), own.end());
      for (int k = 0; k < shape.rows; ++k) {
        w_columns_.insert(w_columns_.end(), own.begin(), own.end());
        row_start_.push_back(w_columns_.size());
      }
    }
    laws_.resize(rows());
    batches[b]->laws(std::span(laws_).last(row_count));
    if (shape.holonomic) holonomic_rows_ = rows();
  }
  rows_in_force_ = rows();
  compliant_rows_ = static_cast<std::size_t>(std::ranges::count_if(laws_, &RowLaw::compliant));
}

std::vector<char> System::angles() const {
  std::vector<char> angles(coordinates(), 0);
  for (const auto& rotor : layout_->rotors) angles[static_cast<std::size_t>(rotor.coordinate)] = 1;
  return angles;
}

bool System::rheonomic() const {
  return std::ranges::any_of(parts_.constraints, [](const auto& batch) { return batch->shape().timed; });
}

System::Evaluation System::evaluation() const {
  return {std::vector<double>(parts_.masses.size()), std::vector<double>(holonomic_rows()),
          std::vector<double>(rows()), std::vector<double>(w_columns_.size())};
}

System::Linearisation System::linearisation() const {
  return {std::vector<double>(w_columns_.size()), std::vector<double>(stiffness_pattern_.size()),
          std::vector<double>(forces_.damping_pattern().size()),
          std::vector<double>(forces_.friction_pattern().size())};
}

template <class F>
void System::on_constraints(double t, const F& f) const {
  for (std::size_t b = 0; b < parts_.constraints.size(); ++b) {
    try {
      Branches::or_naturally<ElementFault>([&] {
        Branches::enter_batch(b);
        f(*parts_.constraints[b], constraint_places_[b]);
      });
    } catch (const ElementFault& fault) {
      const auto number = static_cast<std::size_t>(parts_.constraint_numbers[b][fault.element]);
      throw detail::named(fault, layout_->constraints[number].label(), t);
    }
  }
}

void System::evaluate(const Instant& at, Evaluation& out) const { evaluate_all(at, out, {}); }

void System::evaluate_with_bias(const Instant& at, Evaluation& out, std::span<double> gamma) const {
  evaluate_all(at, out, gamma);
}

void System::evaluate_all(const Instant& at, Evaluation& out, std::span<double> gamma) const {
  if (!out_of_force_.empty()) {
    for (auto* part : {&out.g, &out.psi, &out.w}) std::ranges::fill(*part, 0.0);
    std::ranges::fill(gamma, 0.0);
  }
  Branches::or_naturally<EquationFault>([&] { forces_.evaluate(at, out.force); });
  on_constraints(at.t, [&](const ConstraintBatch& batch, const ConstraintPlaces& own) {
    batch.evaluate(
        at,
        {own.holonomic ? own.rows.in(std::span(out.g)) : std::span<double>{}, own.rows.in(std::span(out.psi)),
         own.w.in(std::span(out.w)), gamma.empty() ? gamma : own.rows.in(gamma)},
        out_of_force(own.rows));
  });
}

void System::bias(const Instant& at, std::span<double> gamma) const {
  if (!out_of_force_.empty()) std::ranges::fill(gamma, 0.0);
  on_constraints(at.t, [&](const ConstraintBatch& batch, const ConstraintPlaces& own) {
    batch.bias(at, own.rows.in(gamma), out_of_force(own.rows));
  });
}

void System::gaps(const Instant& at, std::span<double> g, std::span<double> psi) const {
  std::ranges::fill(g, 0.0);
  std::ranges::fill(psi, 0.0);
  on_constraints(at.t, [&](const ConstraintBatch& batch, const ConstraintPlaces& own) {
    batch.gaps(at, own.holonomic ? own.rows.in(g) : std::span<double>{}, own.rows.in(psi));
  });
}

void System::linearise_constraints(const Instant& at, std::span<const double> lambda,
                                   Linearisation& out) const {
  if (!out_of_force_.empty()) {
    std::ranges::fill(out.psi_q, 0.0);
    std::fill_n(out.stiffness.begin(), stiffness_of_constraints_, 0.0);
  }
  on_constraints(at.t, [&](const ConstraintBatch& batch, const ConstraintPlaces& own) {
    batch.linearise(at, own.rows.in(lambda), own.w.in(std::span(out.psi_q)),
                    own.stiffness.in(std::span(out.stiffness)), out_of_force(own.rows));
  });
}

void System::linearise(const Instant& at, std::span<const double> lambda, Linearisation& out) const {
  linearise_constraints(at, lambda, out);
  linearise_forces(at, lambda, out);
}

void System::forces_at_points(std::span<const double> w, std::span<const double> lengths,
                              std::span<double> out) const {
  std::size_t first_out = 0;
  for (std::size_t b = 0; b < parts_.constraints.size(); ++b) {
    const ConstraintPlaces& own = constraint_places_[b];
    const std::size_t count =
        own.rows.size() * static_cast<std::size_t>(parts_.constraints[b]->shape().inputs);
    parts_.constraints[b]->forces_at_points(own.w.in(w), lengths, out.subspan(first_out, count));
    first_out += count;
  }
}

std::size_t System::size_of_forces_at_points() const {
  std::size_t size = 0;
  for (const Layout::Constraint& c : layout_->constraints)
    size += static_cast<std::size_t>(c.rows * c.inputs);
  return size;
}

void System::constraint_forces(std::span<const double> w, std::span<const double> lambda,
                               std::span<double> slots) const {
  std::ranges::fill(slots, 0.0);
  for (const Layout::Constraint& c : layout_->constraints) {
    for (const std::size_t r : c.own_rows()) {
      std::size_t k = row_start_[r];
      for (const std::size_t slot : c.slots()) slots[slot] += lambda[r] * w[k++];
    }
  }
}

double System::kinetic_energy(std::span<const double> v) const {
  return 0.5 * std::transform_reduce(v.begin(), v.end(), parts_.masses.begin(), 0.0, std::plus<>(),
                                     [](double v_i, double m_i) { return m_i * v_i * v_i; });
}

double System::elastic_energy(std::span<const double> lambda) const {
  double V = 0.0;
  for (std::size_t r = 0; r < lambda.size(); ++r) V += laws_[r].energy(lambda[r]);
  return V;
}

const Layout::Constraint& System::constraint_of_row(std::size_t row, std::size_t& batch) const {
  const auto first = [](const ConstraintPlaces& own) { return own.rows.front(); };
  const auto next = std::ranges::upper_bound(constraint_places_, row, {}, first);
  batch = static_cast<std::size_t>(next - constraint_places_.begin()) - 1;
  const auto i = (row - first(constraint_places_[batch])) /
                 static_cast<std::size_t>(parts_.constraints[batch]->shape().rows);
  return layout_->constraints[static_cast<std::size_t>(parts_.constraint_numbers[batch][i])];
}

std::string System::label_of_batch(std::size_t batch) const {
  const auto of = [](const auto& all, const auto& label) {
    return all.size() == 1 ? label(0)
                           : "one of the " + std::to_string(all.size()) + ' ' + std::string(all.shape().kind);
  };
  if (batch >= parts_.constraints.size()) {
    batch -= parts_.constraints.size();
    return of(forces_.batch(batch), [&](std::size_t i) { return forces_.label(batch, i); });
  }
  const auto& numbers = parts_.constraint_numbers[batch];
  return of(*parts_.constraints[batch], [&](std::size_t i) {
    return layout_->constraints[static_cast<std::size_t>(numbers[i])].label();
  });
}

bool System::timed_batch(std::size_t batch) const {
  const std::size_t constraints = parts_.constraints.size();
  return batch < constraints ? parts_.constraints[batch]->shape().timed
                             : forces_.batch(batch - constraints).shape().timed;
}

std::string System::row_label(std::size_t row) const {
  std::size_t batch = 0;
  return constraint_of_row(row, batch).label();
}

std::string_view System::singular_hint(std::size_t row) const {
  std::size_t batch = 0;
  (void)constraint_of_row(row, batch);
  return parts_.constraints[batch]->shape().singular;
}

}  // namespace dalembert
