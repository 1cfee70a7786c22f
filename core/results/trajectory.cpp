#include "dalembert/core/results/trajectory.h"

#include <dalembert/core/results/ledger.h>

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace dalembert {

void Record::reserve(std::size_t samples, const FlatSample& like) {
  times.reserve(samples);
  unique.reserve(samples * like.unique.size());
  values.reserve(samples * (3 * like.q.size() + like.lambda.size() + like.forces.size() + 1));
}

void Record::append(const FlatSample& sample) {
  coordinates = sample.q.size();
  rows = sample.lambda.size();
  for (const auto& part : {sample.q, sample.v, sample.a, sample.lambda, sample.forces}) {
    values.insert(values.end(), part.begin(), part.end());
  }
  unique.insert(unique.end(), sample.unique.begin(), sample.unique.end());
  values.push_back(sample.energy);
  times.push_back(sample.time);
}

void Record::use_layout(const std::shared_ptr<const Layout>& next) {
  if (next != (later.empty() ? layout : later.back().layout)) later.push_back({times.size(), next});
}

const std::shared_ptr<const Layout>& Record::layout_of(std::size_t sample) const {
  const auto next = std::ranges::upper_bound(later, sample, {}, &Later::first);
  return next == later.begin() ? layout : std::prev(next)->layout;
}

void Record::clear() {
  later.clear();
  times.clear();
  values.clear();
  unique.clear();
}

std::string Record::name_of(const EventRecord& its) const {
  if (its.kind == EventKind::event) {
    const bool named = its.source < event_names.size() && !event_names[its.source].empty();
    return named ? event_names[its.source] : "event " + std::to_string(its.source);
  }
  if (its.source < layout->constraints.size()) return layout->constraints[its.source].name;
  throw InvalidArgument("name_of(): this is nothing that happened in this run; use one of its events()");
}

std::size_t Record::stride() const { return 3 * coordinates + rows + layout->slot_coordinate.size() + 1; }

FlatSample Record::sample(std::size_t i) const {
  const std::size_t n = coordinates;
  const auto one = std::span(values).subspan(i * stride(), stride());
  return {times[i],
          one.first(n),
          one.subspan(n, n),
          one.subspan(2 * n, n),
          one.subspan(3 * n, rows),
          one.subspan(3 * n + rows, layout->slot_coordinate.size()),
          one.back(),
          unique.empty() ? std::span<const char>{} : std::span(unique).subspan(i * rows, rows)};
}

namespace {

/// As the caller wrote it, who may have counted below 0.
std::string number(std::size_t index) { return std::to_string(static_cast<std::ptrdiff_t>(index)); }

}  // namespace

template <int D>
Trajectory<D>::Trajectory(std::shared_ptr<const Record> record) : record_(std::move(record)) {
  if (record_->layout->dimension != D) {
    throw InvalidArgument("Scene \"" + record_->layout->scene + "\" has " +
                          std::to_string(record_->layout->dimension) + " dimensions; read it as Trajectory<" +
                          std::to_string(record_->layout->dimension) + ">");
  }
}
template <int D>
Trajectory<D>::~Trajectory() = default;
template <int D>
Trajectory<D>::Trajectory(const Trajectory&) noexcept = default;
template <int D>
Trajectory<D>& Trajectory<D>::operator=(const Trajectory&) = default;

template <int D>
void Trajectory<D>::require_event(std::size_t k) const {
  if (k < record_->events.size()) return;
  throw InvalidArgument("There is no event " + number(k) + ": in this run " +
                        std::to_string(record_->events.size()) + " happened, counted from 0");
}

template <int D>
Sample<D> Trajectory<D>::event_sample(std::size_t k) const& {
  require_event(k);
  return {*record_->at_events->layout_of(k), record_->at_events->sample(k)};
}

template <int D>
Sample<D> Trajectory<D>::sample_after(std::size_t k) const& {
  require_event(k);
  const auto& after = record_->after_events ? record_->after_events : record_->at_events;
  return {*after->layout_of(k), after->sample(k)};
}

template <int D>
Sample<D> Trajectory<D>::sample(std::size_t i) const& {
  if (i >= size()) {
    throw InvalidArgument("There is no sample " + number(i) + ": this run has " + std::to_string(size()) +
                          ", counted from 0");
  }
  return {*record_->layout_of(i), record_->sample(i)};
}

template <int D>
const Ledger& Trajectory<D>::ledger() const& {
  if (!record_->ledger)
    throw InvalidArgument(
        "ledger(): run it with the option .ledger = true, and ask the run, not what at() reads of it");
  return *record_->ledger;
}

template <int D>
Trajectory<D> Trajectory<D>::at(std::span<const double> times) const {
  if (!record_->dense) {
    throw InvalidArgument(
        "at(): this run kept its samples only; run it with the option .dense = true, or with "
        "the times wanted, .times = {..}");
  }
  auto other = std::make_shared<Record>();
  other->layout = record_->layout;
  other->stepper = record_->stepper;
  other->tolerance = record_->tolerance;
  other->statistics = record_->statistics;
  other->dense = record_->dense;
  other->dense->read(times, *other);
  return Trajectory(std::move(other));
}

template class Trajectory<2>;
template class Trajectory<3>;

}  // namespace dalembert
