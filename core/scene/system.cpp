#include "dalembert/core/scene/system.h"

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/errors.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace dalembert {

System::System(SystemParts parts) {
  auto shared = std::make_shared<Shared>(Shared{.parts = std::move(parts)});
  const auto layout = std::make_shared<Layout>(std::move(shared->parts.layout));
  layout->conditions = std::make_shared<const Conditions>(std::move(shared->parts.conditions));
  Forces all{.batches = {}, .stiffness_pattern = shared->place_constraints(*layout)};
  layout->index_slots(shared->parts.masses.size());
  shared->stiffness_of_constraints = all.stiffness_pattern.size();
  all.batches = ForceBatches(std::move(shared->parts.forces), layout, shared->parts.constraints.size(),
                             all.stiffness_pattern);
  layout->applied = std::make_shared<const AppliedForces>(all.batches.applied());
  shared->layout = layout;
  shared_ = std::move(shared);
  forces_ = std::make_shared<const Forces>(std::move(all));
  rows_in_force_ = rows();
}

std::vector<MatrixEntry> System::Shared::place_constraints(Layout& its_layout) {
  auto& batches = parts.constraints;
  // Holonomic rows first: sort the batches, and with them the numbers of their elements.
  std::vector<std::size_t> order(batches.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t b) { return batches[b]->shape().holonomic; });
  std::vector<std::shared_ptr<const ConstraintBatch>> sorted;
  std::vector<std::vector<int>> numbers;
  for (const std::size_t b : order) {
    sorted.push_back(std::move(batches[b]));
    numbers.push_back(std::move(parts.constraint_numbers[b]));
  }
  batches = std::move(sorted);
  parts.constraint_numbers = std::move(numbers);

  std::vector<MatrixEntry> stiffness;
  auto& slots = its_layout.slot_coordinate;
  const auto rows = [this] { return row_start.size() - 1; };
  for (std::size_t b = 0; b < batches.size(); ++b) {
    const ConstraintShape shape = batches[b]->shape();
    const auto width = static_cast<std::size_t>(shape.width);
    const auto coordinates = batches[b]->coordinates();
    const std::size_t row_count = batches[b]->size() * static_cast<std::size_t>(shape.rows);
    constraint_places.push_back(
        {Places::from(rows(), row_count), Places::from(w_columns.size(), row_count * width),
         Places::from(stiffness.size(), batches[b]->size() * width * width), shape.holonomic});
    detail::append_blocks(coordinates, width, stiffness);
    for (std::size_t i = 0; i < batches[b]->size(); ++i) {
      auto& info = its_layout.constraints[static_cast<std::size_t>(parts.constraint_numbers[b][i])];
      info.first_row = static_cast<int>(rows());
      info.first_slot = static_cast<int>(slots.size());
      const auto own = coordinates.subspan(i * width, width);
      slots.insert(slots.end(), own.begin(), own.end());
      for (int k = 0; k < shape.rows; ++k) {
        w_columns.insert(w_columns.end(), own.begin(), own.end());
        row_start.push_back(w_columns.size());
      }
    }
    laws.resize(rows());
    batches[b]->laws(std::span(laws).last(row_count));
    if (shape.holonomic) holonomic_rows = rows();
  }
  compliant_rows = static_cast<std::size_t>(std::ranges::count_if(laws, &RowLaw::compliant));
  return stiffness;
}

std::vector<char> System::angles() const {
  std::vector<char> angles(coordinates(), 0);
  for (const auto& rotor : layout()->rotors) angles[static_cast<std::size_t>(rotor.coordinate)] = 1;
  return angles;
}

bool System::rheonomic() const {
  return std::ranges::any_of(batches(), [](const auto& batch) { return batch->shape().timed; });
}

System::Evaluation System::evaluation() const {
  return {std::vector<double>(coordinates()), std::vector<double>(holonomic_rows()),
          std::vector<double>(rows()), std::vector<double>(w_columns().size())};
}

System::Linearisation System::linearisation() const {
  return {std::vector<double>(w_columns().size()), std::vector<double>(stiffness_pattern().size()),
          std::vector<double>(forces().damping_pattern().size()),
          std::vector<double>(forces().friction_pattern().size())};
}

template <class F>
void System::on_constraints(double t, const F& f) const {
  for (std::size_t b = 0; b < batches().size(); ++b) {
    try {
      Branches::or_naturally<ElementFault>([&] {
        Branches::enter_batch(b);
        f(*batches()[b], shared_->constraint_places[b]);
      });
    } catch (const ElementFault& fault) {
      const auto number = static_cast<std::size_t>(numbers(b)[fault.element]);
      throw detail::named(fault, layout()->constraints[number].label(), t);
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
  Branches::or_naturally<EquationFault>([&] { forces().evaluate(at, out.force); });
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
    std::fill_n(out.stiffness.begin(), stiffness_of_constraints(), 0.0);
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
  for (std::size_t b = 0; b < batches().size(); ++b) {
    const ConstraintPlaces& own = shared_->constraint_places[b];
    const std::size_t count = own.rows.size() * static_cast<std::size_t>(batches()[b]->shape().inputs);
    batches()[b]->forces_at_points(own.w.in(w), lengths, out.subspan(first_out, count));
    first_out += count;
  }
}

std::size_t System::size_of_forces_at_points() const {
  std::size_t size = 0;
  for (const Layout::Constraint& c : layout()->constraints)
    size += static_cast<std::size_t>(c.rows * c.inputs);
  return size;
}

void System::constraint_forces(std::span<const double> w, std::span<const double> lambda,
                               std::span<double> slots) const {
  std::ranges::fill(slots, 0.0);
  for (const Layout::Constraint& c : layout()->constraints) {
    for (const std::size_t r : c.own_rows()) {
      std::size_t k = row(r).front();
      for (const std::size_t slot : c.slots()) slots[slot] += lambda[r] * w[k++];
    }
  }
}

double System::kinetic_energy(std::span<const double> v) const {
  return 0.5 * std::transform_reduce(v.begin(), v.end(), masses().begin(), 0.0, std::plus<>(),
                                     [](double v_i, double m_i) { return m_i * v_i * v_i; });
}

double System::elastic_energy(std::span<const double> lambda) const {
  double V = 0.0;
  for (std::size_t r = 0; r < lambda.size(); ++r) V += law(r).energy(lambda[r]);
  return V;
}

const Layout::Constraint& System::constraint_of_row(std::size_t row, std::size_t& batch) const {
  const auto first = [](const ConstraintPlaces& own) { return own.rows.front(); };
  const auto next = std::ranges::upper_bound(shared_->constraint_places, row, {}, first);
  batch = static_cast<std::size_t>(next - shared_->constraint_places.begin()) - 1;
  const auto i = (row - first(shared_->constraint_places[batch])) /
                 static_cast<std::size_t>(batches()[batch]->shape().rows);
  return layout()->constraints[static_cast<std::size_t>(numbers(batch)[i])];
}

std::string System::label_of_batch(std::size_t batch) const {
  const auto of = [](const auto& all, const auto& label) {
    return all.size() == 1 ? label(0)
                           : "one of the " + std::to_string(all.size()) + ' ' + std::string(all.shape().kind);
  };
  if (batch >= batches().size()) {
    batch -= batches().size();
    return of(forces().batch(batch), [&](std::size_t i) { return forces().label(batch, i); });
  }
  return of(*batches()[batch], [&](std::size_t i) {
    return layout()->constraints[static_cast<std::size_t>(numbers(batch)[i])].label();
  });
}

bool System::timed_batch(std::size_t batch) const {
  const std::size_t constraints = batches().size();
  return batch < constraints ? batches()[batch]->shape().timed
                             : forces().batch(batch - constraints).shape().timed;
}

std::string System::row_label(std::size_t row) const {
  std::size_t batch = 0;
  return constraint_of_row(row, batch).label();
}

std::string_view System::singular_hint(std::size_t row) const {
  std::size_t batch = 0;
  (void)constraint_of_row(row, batch);
  return batches()[batch]->shape().singular;
}

}  // namespace dalembert
