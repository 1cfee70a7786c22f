#pragma once

#include <dalembert/core/analysis/islands.h>
#include <dalembert/core/results/applied_forces.h>
#include <dalembert/core/results/sample.h>
#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/base/irregular.h>
#include <dalembert/solvers/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A sample of which every number is some roundings beside that of another one. A number may be 0 because
/// others cancel, so it is rounded as the largest of its kind is in its uncoupled part of the scene, where
/// that is larger than itself: of lengths or angles, their rates and accelerations, and the forces there. At
/// rest all rates are noise: they are rounded as those that the part's forces give it over its size.
class RoundedSample {
 public:
  /// Of scenes with this characteristic length.
  RoundedSample(const System& system, double length)
      : layout_(system.layout()),
        length_(length),
        masses_(system.masses().begin(), system.masses().end()),
        applied_(masses_.size()) {
    const Islands parts = islands(system);
    const auto is_angle = system.angles();
    for (std::size_t i = 0; i < masses_.size(); ++i)
      kind_.push_back(2 * parts.of_coordinate[i] + (is_angle[i] ? 1 : 0));
    sizes_.resize(2 * parts.count);
    nudges_ =
        irregular(patterns + std::max({masses_.size(), layout_->slot_coordinate.size(), system.rows()}));
  }

  /// Throws what forces throw.
  void measure(const FlatSample& at) {
    here_ = at;
    std::ranges::fill(applied_, 0.0);
    layout_->applied->raise_to_sizes({at.time, at.q, at.v}, at.lambda, applied_);
    sizes_.assign(sizes_.size(), {});
    for (std::size_t i = 0; i < masses_.size(); ++i) {
      Sizes& its = sizes_[kind_[i]];
      its = {std::max(its.q, std::abs(at.q[i])), std::max(its.v, std::abs(at.v[i])),
             std::max({its.a, std::abs(at.a[i]), applied_[i] / masses_[i]})};
    }
    for (std::size_t k = 0; k < at.forces.size(); ++k) {
      const std::size_t i = coordinate_of_slot(k);
      sizes_[kind_[i]].a = std::max(sizes_[kind_[i]].a, std::abs(at.forces[k]) / masses_[i]);
    }
    for (std::size_t part = 0; part < sizes_.size(); part += 2) complete(sizes_[part], sizes_[part + 1]);
    forces_.resize(at.forces.size());
    for (std::size_t k = 0; k < forces_.size(); ++k)
      forces_[k] = masses_[coordinate_of_slot(k)] * sizes_[kind_[coordinate_of_slot(k)]].a;
    measure_multipliers();
    energy_ = std::abs(at.energy);
    for (std::size_t i = 0; i < masses_.size(); ++i) energy_ += 0.5 * masses_[i] * at.v[i] * at.v[i];
  }

  static constexpr std::size_t patterns = 3;
  /// Each number up or down by at most so many roundings, in one of several patterns.
  [[nodiscard]] FlatSample beside(std::size_t pattern, double roundings) {
    FlatSample beside = here_;
    const Nudge nudge{std::span(nudges_).subspan(pattern), roundings * epsilon};
    const auto of = [&](double Sizes::*kind) {
      return [this, kind](std::size_t i) { return sizes_[kind_[i]].*kind; };
    };
    beside.q = nudge(here_.q, of(&Sizes::q), q_);
    beside.v = nudge(here_.v, of(&Sizes::v), v_);
    beside.a = nudge(here_.a, of(&Sizes::a), a_);
    beside.lambda = nudge(
        here_.lambda, [&](std::size_t k) { return multipliers_[k]; }, lambda_);
    beside.forces = nudge(
        here_.forces, [&](std::size_t k) { return forces_[k]; }, slots_);
    beside.energy += nudge.by * energy_;
    return beside;
  }

 private:
  struct Sizes {
    double q = 0.0, v = 0.0, a = 0.0;
  };

  /// Lengths are no smaller than those by which a part's path bends, up to that of the scene, wherever the
  /// origin lies; rates no smaller than what its accelerations give over these.
  void complete(Sizes& lengths, Sizes& angles) const {
    const double bends = lengths.a > 0.0   ? lengths.v * lengths.v / lengths.a
                         : lengths.v > 0.0 ? length_
                                           : 0.0;
    lengths.q = std::max(lengths.q, std::min(length_, bends));
    angles.q = std::max(angles.q, 1.0);
    for (Sizes* its : {&lengths, &angles}) its->v = std::max(its->v, std::sqrt(its->a * its->q));
  }

  [[nodiscard]] std::size_t coordinate_of_slot(std::size_t k) const {
    return static_cast<std::size_t>(layout_->slot_coordinate[k]);
  }

  /// What a multiplier is in units of its forces is told by these, however small they are; where both are 0
  /// nothing is known.
  void measure_multipliers() {
    multipliers_.assign(here_.lambda.size(), 0.0);
    for (const Layout::Constraint& c : layout_->constraints) {
      double multiplier = 0.0, force = 0.0, size = 0.0;
      for (const std::size_t k : c.own_rows()) multiplier = std::max(multiplier, std::abs(here_.lambda[k]));
      for (const std::size_t k : c.slots()) {
        force = std::max(force, std::abs(here_.forces[k]));
        size = std::max(size, forces_[k]);
      }
      for (const std::size_t k : c.own_rows())
        multipliers_[k] = force > 0.0 ? size / force * multiplier : multiplier;
    }
  }

  struct Nudge {
    std::span<const double> along;
    double by;

    template <class SizeOf>
    std::span<const double> operator()(std::span<const double> x, const SizeOf& size,
                                       std::vector<double>& to) const {
      to.resize(x.size());
      for (std::size_t i = 0; i < x.size(); ++i)
        to[i] = x[i] + along[i] * by * std::max(std::abs(x[i]), size(i));
      return to;
    }
  };

  std::shared_ptr<const Layout> layout_;
  double length_;
  std::vector<double> masses_;     ///< of each coordinate, or inertias,
  std::vector<double> applied_;    ///< the largest force that is applied to it,
  std::vector<std::size_t> kind_;  ///< and which of the sizes it has
  FlatSample here_;
  std::vector<Sizes> sizes_;                  ///< of lengths and of angles of each island
  std::vector<double> forces_, multipliers_;  ///< how large they are
  double energy_ = 0.0;
  std::vector<double> nudges_;
  std::vector<double> q_, v_, a_, lambda_, slots_;
};

}  // namespace dalembert
