#include "dalembert/view/quantities.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dalembert {

Quantities::Quantities(std::vector<Shown> shown, const TwoRuns* certified)
    : shown_(std::move(shown)), certified_(certified), columns_(shown_.size()) {}

std::vector<std::size_t> Quantities::add(int numbers, const Reading& read) {
  std::vector<double> now(static_cast<std::size_t>(numbers));
  std::vector<std::vector<double>> all(now.size(), std::vector<double>(shown_.size()));
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    read(shown_[i].sample(), now);
    for (std::size_t k = 0; k < now.size(); ++k) all[k][i] = now[k];
  }
  std::vector<std::size_t> columns;
  for (const auto& column : all) columns.push_back(columns_.add([&](std::size_t i) { return column[i]; }));
  return columns;
}

std::optional<std::size_t> Quantities::add_error(int numbers, Kind kind, const Reading& read) {
  if (certified_ == nullptr) return {};
  return columns_.add([&](std::size_t i) { return error(shown_[i], numbers, kind, read); });
}

/// As Certificate has them: what round-off in the states, or in the largest force, is at least.
double Quantities::floor_of(Kind kind, const Certainty& its) const {
  switch (kind) {
    case Kind::position:
      return its.of_states * certified_->length();
    case Kind::velocity:
      return its.of_states * certified_->speed();
    case Kind::angle:
      return its.of_states;
    case Kind::angular_velocity:
      return its.of_states * certified_->speed() / certified_->length();
    case Kind::force:
      return certified_->error_of_force(0.0, its);
    case Kind::other:
      break;
  }
  return 0.0;
}

namespace {

Certainty certainty_of(Quantities::Kind kind, const Certainty& its) {
  using Kind = Quantities::Kind;
  if (kind == Kind::position || kind == Kind::angle) return its.of_positions();
  if (kind == Kind::velocity || kind == Kind::angular_velocity) return its.of_velocities();
  return its;
}

}  // namespace

double Quantities::error(const Shown& at, int numbers, Kind kind, const Reading& read) const {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  if (at.certainty == nullptr) return unknown;
  const Certainty its = certainty_of(kind, *at.certainty);
  if (its.doubt != Doubt::none) return unknown;
  std::vector<double> own(static_cast<std::size_t>(numbers)), other(own.size());
  read(at.sample(), own);
  read(at.reference->sample(its.counterpart), other);
  double size = 0.0, apart = 0.0;
  for (std::size_t k = 0; k < own.size(); ++k) {
    size += own[k] * own[k];
    apart += (own[k] - other[k]) * (own[k] - other[k]);
  }
  if (std::isnan(apart)) return unknown;
  double error = certified_->error(std::sqrt(apart), std::sqrt(size), its);
  if (certified_->vibrates()) {
    const auto moved = certified_->moved(at.sample());
    read(moved.flat, other);
    double by = 0.0;
    for (std::size_t k = 0; k < own.size(); ++k) by += (own[k] - other[k]) * (own[k] - other[k]);
    error = by >= 0.0 ? std::max(error, std::sqrt(by)) : unknown;
  }
  return std::max(error, floor_of(kind, its));
}

}  // namespace dalembert
