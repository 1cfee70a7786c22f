#include <dalembert/core/autodiff/branches.h>
#include <dalembert/core/errors.h>
#include <dalembert/core/scene/system.h>

#include <algorithm>
#include <numeric>

namespace dalembert {

void System::sort_forces() {
  std::vector<std::size_t> order(parts_.forces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto reading = std::stable_partition(
      order.begin(), order.end(), [this](std::size_t b) { return parts_.forces[b]->shape().rows == 0; });
  first_reading_ = static_cast<std::size_t>(reading - order.begin());
  std::vector<std::shared_ptr<const ForceBatch>> batches;
  std::vector<std::vector<int>> numbers;
  for (const std::size_t b : order) {
    batches.push_back(std::move(parts_.forces[b]));
    numbers.push_back(std::move(parts_.force_numbers[b]));
  }
  parts_.forces = std::move(batches);
  parts_.force_numbers = std::move(numbers);
}

void System::place_forces(const Layout& layout) {
  for (std::size_t b = force_places_.size(); b < parts_.forces.size(); ++b) {
    const ForceBatch& batch = *parts_.forces[b];
    const ForceShape shape = batch.shape();
    const auto width = static_cast<std::size_t>(shape.width), rows = static_cast<std::size_t>(shape.rows);
    const std::size_t blocks = batch.size() * width * width;
    ForcePlaces own{Places::from(multiplier_force_pattern_.size(), batch.size() * rows * width),
                    Places::from(stiffness_pattern_.size(), blocks),
                    Places::from(damping_pattern_.size(), shape.dissipative ? blocks : 0)};
    append_blocks(batch.coordinates(), width, stiffness_pattern_);
    if (shape.dissipative) append_blocks(batch.coordinates(), width, damping_pattern_);
    for (std::size_t i = 0; i < batch.constraints().size(); ++i) {
      const auto constraint = static_cast<std::size_t>(batch.constraints()[i]);
      own.first_row.push_back(layout.constraints[constraint].own_rows().front());
      for (std::size_t r = 0; r < rows; ++r) {
        for (const int coordinate : batch.coordinates().subspan(i * width, width))
          multiplier_force_pattern_.push_back({static_cast<std::size_t>(coordinate), own.first_row[i] + r});
      }
    }
    force_places_.push_back(std::move(own));
  }
}

template <class F>
void System::on_forces(std::size_t from, std::size_t end, const Instant& at, std::span<const double> lambda,
                       const F& f) const {
  for (std::size_t b = from; b < end; ++b) {
    const ForcePlaces& own = force_places_[b];
    try {
      Branches::enter_batch(parts_.constraints.size() + b);
      f(*parts_.forces[b], Multipliers{lambda, own.first_row}, own);
    } catch (const ElementFault& fault) {
      throw EquationFault(force_label(b, fault.element) + ' ' + fault.what + at_time(at.t));
    }
  }
}

void System::add_forces(const Instant& at, std::span<double> F) const {
  on_forces(0, first_reading_, at, {},
            [&](const ForceBatch& batch, const Multipliers& none, const ForcePlaces&) {
              batch.add_force(at, none, F);
            });
}

void System::add_multiplier_forces(const Instant& at, std::span<const double> lambda,
                                   std::span<double> F) const {
  on_forces(first_reading_, parts_.forces.size(), at, lambda,
            [&](const ForceBatch& batch, const Multipliers& read, const ForcePlaces&) {
              batch.add_force(at, read, F);
            });
}

void System::multiplier_force_slope(const Instant& at, std::span<const double> lambda,
                                    std::span<double> out) const {
  const auto write = [&](const ForceBatch& batch, const Multipliers& read, const ForcePlaces& own) {
    batch.slope(at, read, own.slope.in(out));
  };
  Branches::or_naturally<EquationFault>(
      [&] { on_forces(first_reading_, parts_.forces.size(), at, lambda, write); });
}

void System::linearise_forces(const Instant& at, std::span<const double> lambda, Linearisation& out) const {
  multiplier_force_slope(at, lambda, out.friction);
  const auto linearise = [&](const ForceBatch& batch, const Multipliers& read, const ForcePlaces& own) {
    batch.linearise(at, read, own.stiffness.in(std::span(out.stiffness)),
                    own.damping.in(std::span(out.damping)));
  };
  Branches::or_naturally<EquationFault>([&] { on_forces(0, parts_.forces.size(), at, lambda, linearise); });
}

void System::exert_sliding(const Instant& at, std::span<double> lambda, std::span<double> slots) const {
  auto next = slides_.begin();
  on_forces(stated_forces_, parts_.forces.size(), at, lambda,
            [&](const ForceBatch&, const Multipliers& read, const ForcePlaces&) {
              (*next++)->exert(at, read.first_row, lambda, slots);
            });
}

double System::potential_energy(const Instant& at) const {
  double V = -std::inner_product(at.q.begin(), at.q.end(), parts_.constant_force.begin(), 0.0);
  on_forces(0, first_reading_, at, {},
            [&](const ForceBatch& batch, const Multipliers&, const ForcePlaces&) { V += batch.energy(at); });
  return V;
}

void System::for_each_force_power(const Instant& at, std::span<const double> lambda,
                                  const std::function<void(std::string, double)>& f) const {
  for (std::size_t b = 0; b < parts_.forces.size(); ++b) {
    std::vector<double> power(parts_.forces[b]->size());
    parts_.forces[b]->power(at, {lambda, force_places_[b].first_row}, power);
    for (std::size_t i = 0; i < power.size(); ++i) f(force_label(b, i), power[i]);
  }
}

/// What slides is a constraint.
std::string System::force_label(std::size_t batch, std::size_t element) const {
  const auto number = static_cast<std::size_t>(parts_.force_numbers[batch][element]);
  return batch < stated_forces_ ? layout_->forces[number].label() : layout_->constraints[number].label();
}

std::string System::label_of_batch(std::size_t batch) const {
  const auto of = [](const auto& all, const auto& label) {
    return all.size() == 1 ? label(0)
                           : "one of the " + std::to_string(all.size()) + ' ' + std::string(all.shape().kind);
  };
  if (batch < parts_.constraints.size()) {
    const auto& numbers = parts_.constraint_numbers[batch];
    return of(*parts_.constraints[batch], [&](std::size_t i) {
      return layout_->constraints[static_cast<std::size_t>(numbers[i])].label();
    });
  }
  batch -= parts_.constraints.size();
  return of(*parts_.forces[batch], [&](std::size_t i) { return force_label(batch, i); });
}

bool System::timed_batch(std::size_t batch) const {
  const std::size_t constraints = parts_.constraints.size();
  return batch < constraints ? parts_.constraints[batch]->shape().timed
                             : parts_.forces[batch - constraints]->shape().timed;
}

std::string System::force_of(std::size_t entry, Places ForcePlaces::*array) const {
  const auto owns = [&](const ForcePlaces& own) {
    return entry < (own.*array).front() + (own.*array).size();
  };
  const auto own = std::ranges::find_if(force_places_, owns);
  const auto batch = static_cast<std::size_t>(own - force_places_.begin());
  const Places part = *own.*array;
  return force_label(batch, (entry - part.front()) * parts_.forces[batch]->size() / part.size());
}

std::string System::force_of_stiffness(std::size_t entry) const {
  return force_of(entry, &ForcePlaces::stiffness);
}
std::string System::name_of_multiplier_force(std::size_t entry) const {
  return force_of(entry, &ForcePlaces::slope);
}

}  // namespace dalembert
