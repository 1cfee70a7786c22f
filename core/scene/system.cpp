#include "dalembert/core/scene/system.h"

#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/errors.h>

#include <algorithm>
#include <iomanip>
#include <numeric>
#include <sstream>
#include <utility>

namespace dalembert {

namespace {

template <class T>
std::span<T> part(std::vector<T>& all, std::size_t first, std::size_t count) {
  return std::span(all).subspan(first, count);
}

}  // namespace

std::string System::at_time(double t) {
  std::ostringstream out;
  out << " (t = " << std::setprecision(10) << t << ')';
  return out.str();
}

void System::append_blocks(std::span<const int> coordinates, std::size_t width, std::vector<Entry>& pattern) {
  for (std::size_t first = 0; first < coordinates.size(); first += width) {
    for (const int row : coordinates.subspan(first, width)) {
      for (const int column : coordinates.subspan(first, width))
        pattern.push_back({static_cast<std::size_t>(row), static_cast<std::size_t>(column)});
    }
  }
}

System::System(SystemParts parts) : parts_(std::move(parts)) {
  place_constraints();
  stiffness_of_constraints_ = stiffness_pattern_.size();
  place_forces();
  place_frictions(parts_.layout);
  stated_frictions_ = parts_.frictions.size();
  stated_friction_entries_ = friction_pattern_.size();
  index_layout();
  layout_ = std::make_shared<const Layout>(std::move(parts_.layout));
}

void System::place_constraints() {
  auto& batches = parts_.constraints;
  // Holonomic rows first: sort the batches, and with them the numbers of their elements.
  std::vector<std::size_t> order(batches.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t b) { return batches[b]->shape().holonomic; });
  std::vector<detail::Owned<ConstraintBatch>> sorted;
  std::vector<std::vector<int>> numbers;
  for (const std::size_t b : order) {
    sorted.push_back(std::move(batches[b]));
    numbers.push_back(std::move(parts_.constraint_numbers[b]));
  }
  batches = std::move(sorted);
  parts_.constraint_numbers = std::move(numbers);

  row_start_.push_back(0);
  auto& slots = parts_.layout.slot_coordinate;
  for (std::size_t b = 0; b < batches.size(); ++b) {
    const ConstraintShape shape = batches[b]->shape();
    const auto width = static_cast<std::size_t>(shape.width);
    const auto coordinates = batches[b]->coordinates();
    const std::size_t row_count = batches[b]->size() * static_cast<std::size_t>(shape.rows);
    constraint_offsets_.push_back({row_start_.size() - 1, w_columns_.size(), stiffness_pattern_.size(), 0,
                                   shape.holonomic, row_count, row_count * width});
    append_blocks(coordinates, width, stiffness_pattern_);
    for (std::size_t i = 0; i < batches[b]->size(); ++i) {
      auto& info = parts_.layout.constraints[static_cast<std::size_t>(parts_.constraint_numbers[b][i])];
      info.first_row = static_cast<int>(rows());
      info.first_slot = static_cast<int>(slots.size());
      const auto own = coordinates.subspan(i * width, width);
      slots.insert(slots.end(), own.begin(), own.end());
      for (int k = 0; k < shape.rows; ++k) {
        w_columns_.insert(w_columns_.end(), own.begin(), own.end());
        row_start_.push_back(w_columns_.size());
      }
    }
    compliance_.resize(row_start_.size() - 1);
    batches[b]->compliance(std::span(compliance_).last(row_count));
    if (shape.holonomic) holonomic_rows_ = rows();
  }
  rows_in_force_ = rows();
  compliant_rows_ =
      static_cast<std::size_t>(std::ranges::count_if(compliance_, [](double C) { return C > 0.0; }));
}

void System::place_forces() {
  for (const auto& batch : parts_.forces) {
    const ForceShape shape = batch->shape();
    force_offsets_.push_back({0, 0, stiffness_pattern_.size(), damping_pattern_.size()});
    append_blocks(batch->coordinates(), static_cast<std::size_t>(shape.width), stiffness_pattern_);
    if (shape.dissipative) {
      append_blocks(batch->coordinates(), static_cast<std::size_t>(shape.width), damping_pattern_);
    }
  }
}

std::vector<double> System::coordinate_scales(double length) const {
  std::vector<double> scales(parts_.masses.size(), length);
  for (const auto& rotor : layout_->rotors) scales[static_cast<std::size_t>(rotor.coordinate)] = 1.0;
  return scales;
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
          std::vector<double>(damping_pattern_.size()), std::vector<double>(friction_pattern_.size())};
}

template <class F>
void System::on_constraints(double t, const F& f) const {
  for (std::size_t b = 0; b < parts_.constraints.size(); ++b) {
    try {
      Branches::begin_batch(b);
      f(*parts_.constraints[b], constraint_offsets_[b]);
    } catch (const ElementFault& fault) {
      const auto number = static_cast<std::size_t>(parts_.constraint_numbers[b][fault.element]);
      throw EquationFault(layout_->constraints[number].label() + ' ' + fault.what + at_time(t));
    }
  }
}

template <class F>
void System::on_forces(double t, const F& f) const {
  for (std::size_t b = 0; b < parts_.forces.size(); ++b) {
    try {
      Branches::begin_batch(parts_.constraints.size() + b);
      f(*parts_.forces[b], force_offsets_[b]);
    } catch (const ElementFault& fault) {
      throw EquationFault(force_label(b, fault.element) + ' ' + fault.what + at_time(t));
    }
  }
}

std::string System::force_label(std::size_t batch, std::size_t element) const {
  return layout_->forces[static_cast<std::size_t>(parts_.force_numbers[batch][element])].label();
}

void System::evaluate(const Instant& at, Evaluation& out) const {
  std::ranges::copy(parts_.constant_force, out.force.begin());
  if (!out_of_force_.empty()) {
    for (auto* part : {&out.g, &out.psi, &out.w}) std::ranges::fill(*part, 0.0);
  }
  on_forces(at.t, [&](const ForceBatch& batch, const Offsets&) { batch.add_force(at, out.force); });
  on_constraints(at.t, [&](const ConstraintBatch& batch, const Offsets& first) {
    batch.evaluate(at, {first.holonomic ? part(out.g, first.row, first.row_count) : std::span<double>{},
                        part(out.psi, first.row, first.row_count), part(out.w, first.w, first.w_count)});
  });
}

void System::bias(const Instant& at, std::span<double> gamma) const {
  if (!out_of_force_.empty()) std::ranges::fill(gamma, 0.0);
  on_constraints(at.t, [&](const ConstraintBatch& batch, const Offsets& first) {
    batch.bias(at, gamma.subspan(first.row, first.row_count));
  });
}

void System::gaps(const Instant& at, std::span<double> g, std::span<double> psi) const {
  std::ranges::fill(g, 0.0);
  std::ranges::fill(psi, 0.0);
  on_constraints(at.t, [&](const ConstraintBatch& batch, const Offsets& first) {
    batch.gaps(at, first.holonomic ? g.subspan(first.row, first.row_count) : std::span<double>{},
               psi.subspan(first.row, first.row_count));
  });
}

void System::linearise_constraints(const Instant& at, std::span<const double> lambda,
                                   Linearisation& out) const {
  if (!out_of_force_.empty()) {
    std::ranges::fill(out.psi_q, 0.0);
    std::fill_n(out.stiffness.begin(), stiffness_of_constraints_, 0.0);
  }
  on_constraints(at.t, [&](const ConstraintBatch& batch, const Offsets& first) {
    const ConstraintShape shape = batch.shape();
    const auto width = static_cast<std::size_t>(shape.width);
    const std::size_t count = batch.size() * static_cast<std::size_t>(shape.rows);
    batch.linearise(at, lambda.subspan(first.row, count), part(out.psi_q, first.w, count * width),
                    part(out.stiffness, first.stiffness, batch.size() * width * width));
  });
}

void System::linearise(const Instant& at, std::span<const double> lambda, Linearisation& out) const {
  linearise_constraints(at, lambda, out);
  linearise_forces(at, lambda, out);
}

void System::linearise_forces(const Instant& at, std::span<const double> lambda, Linearisation& out) const {
  on_forces(at.t, [&](const ForceBatch& batch, const Offsets& first) {
    const ForceShape shape = batch.shape();
    const std::size_t entries = batch.size() * static_cast<std::size_t>(shape.width * shape.width);
    batch.linearise(at, part(out.stiffness, first.stiffness, entries),
                    part(out.damping, first.damping, shape.dissipative ? entries : 0));
  });
  if (frictional()) linearise_frictions(at, lambda, out);
}

void System::forces_at_points(std::span<const double> w, std::span<const double> lengths,
                              std::span<double> out) const {
  std::size_t first_out = 0;
  for (std::size_t b = 0; b < parts_.constraints.size(); ++b) {
    const Offsets& first = constraint_offsets_[b];
    const std::size_t count =
        first.row_count * static_cast<std::size_t>(parts_.constraints[b]->shape().inputs);
    parts_.constraints[b]->forces_at_points(w.subspan(first.w, first.w_count), lengths,
                                            out.subspan(first_out, count));
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
    for (int k = 0; k < c.rows; ++k) {
      const auto row = static_cast<std::size_t>(c.first_row + k);
      const std::size_t first_w = row_start_[row];
      for (std::size_t j = 0; j < static_cast<std::size_t>(c.width); ++j) {
        slots[static_cast<std::size_t>(c.first_slot) + j] += lambda[row] * w[first_w + j];
      }
    }
  }
}

double System::kinetic_energy(std::span<const double> v) const {
  return 0.5 * std::transform_reduce(v.begin(), v.end(), parts_.masses.begin(), 0.0, std::plus<>(),
                                     [](double v_i, double m_i) { return m_i * v_i * v_i; });
}

double System::potential_energy(const Instant& at) const {
  double V = -std::inner_product(at.q.begin(), at.q.end(), parts_.constant_force.begin(), 0.0);
  on_forces(at.t, [&](const ForceBatch& batch, const Offsets&) { V += batch.energy(at); });
  return V;
}

double System::elastic_energy(std::span<const double> lambda) const {
  double V = 0.0;
  for (std::size_t r = 0; r < lambda.size(); ++r) V += 0.5 * compliance_[r] * lambda[r] * lambda[r];
  return V;
}

double System::constant_power(std::span<const double> v) const {
  return std::inner_product(v.begin(), v.end(), parts_.constant_force.begin(), 0.0);
}

void System::for_each_force_power(const Instant& at, std::span<const double> lambda,
                                  const std::function<void(std::string, double)>& f) const {
  for (std::size_t b = 0; b < parts_.forces.size(); ++b) {
    std::vector<double> power(parts_.forces[b]->size());
    parts_.forces[b]->power(at, power);
    for (std::size_t i = 0; i < power.size(); ++i) f(force_label(b, i), power[i]);
  }
  for (std::size_t b = 0; b < parts_.frictions.size(); ++b) {
    std::vector<double> power(parts_.frictions[b]->size());
    parts_.frictions[b]->power(at, {lambda, friction_places_[b].first_row}, power);
    for (std::size_t i = 0; i < power.size(); ++i) f(friction_label(b, i), power[i]);
  }
}

std::string System::force_of_stiffness(std::size_t entry) const {
  if (frictional() && entry >= friction_places_.front().stiffness) return friction_of_stiffness(entry);
  const auto next = std::ranges::upper_bound(force_offsets_, entry, {}, &Offsets::stiffness);
  const auto batch = static_cast<std::size_t>(next - force_offsets_.begin()) - 1;
  const int width = parts_.forces[batch]->shape().width;
  return force_label(batch,
                     (entry - force_offsets_[batch].stiffness) / static_cast<std::size_t>(width * width));
}

const Layout::Constraint& System::constraint_of_row(std::size_t row, std::size_t& batch) const {
  const auto next = std::ranges::upper_bound(constraint_offsets_, row, {}, &Offsets::row);
  batch = static_cast<std::size_t>(next - constraint_offsets_.begin()) - 1;
  const auto i = (row - constraint_offsets_[batch].row) /
                 static_cast<std::size_t>(parts_.constraints[batch]->shape().rows);
  return layout_->constraints[static_cast<std::size_t>(parts_.constraint_numbers[batch][i])];
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
