#pragma once

#include <dalembert/core/analysis/islands.h>
#include <dalembert/core/results/sample.h>
#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A sample of which every number is some roundings beside that of another one. A number may be 0 because
/// others cancel, so it is rounded as the largest of its kind is in its uncoupled part of the scene, where
/// that is larger than itself: of lengths or angles, their rates and accelerations, and the forces there.
class RoundedSample {
 public:
  explicit RoundedSample(const System& system)
      : layout_(system.layout()), masses_(system.masses().begin(), system.masses().end()) {
    const Islands parts = islands(system);
    const auto is_angle = system.angles();
    for (std::size_t i = 0; i < masses_.size(); ++i)
      kind_.push_back(2 * parts.of_coordinate[i] + (is_angle[i] ? 1 : 0));
    sizes_.resize(2 * parts.count);
  }

  void measure(const FlatSample& at) {
    here_ = at;
    for (std::size_t kind = 0; kind < sizes_.size(); ++kind) sizes_[kind] = {.q = kind % 2 == 0 ? 0.0 : 1.0};
    for (std::size_t i = 0; i < masses_.size(); ++i) {
      Sizes& its = sizes_[kind_[i]];
      its = {std::max(its.q, std::abs(at.q[i])), std::max(its.v, std::abs(at.v[i])),
             std::max(its.a, std::abs(at.a[i]))};
    }
    for (std::size_t k = 0; k < at.forces.size(); ++k) {
      const std::size_t i = coordinate_of_slot(k);
      sizes_[kind_[i]].a = std::max(sizes_[kind_[i]].a, std::abs(at.forces[k]) / masses_[i]);
    }
    forces_.resize(at.forces.size());
    for (std::size_t k = 0; k < forces_.size(); ++k)
      forces_[k] = masses_[coordinate_of_slot(k)] * sizes_[kind_[coordinate_of_slot(k)]].a;
    measure_multipliers();
    energy_ = std::abs(at.energy);
    for (std::size_t i = 0; i < masses_.size(); ++i) energy_ += 0.5 * masses_[i] * at.v[i] * at.v[i];
  }

  /// Each number up or down by so many roundings, by turns of so many.
  [[nodiscard]] FlatSample by_turns(std::size_t turns, double roundings) {
    FlatSample beside = here_;
    const double rounding = roundings * epsilon;
    const auto of = [&](double Sizes::*kind) {
      return [this, kind](std::size_t i) { return sizes_[kind_[i]].*kind; };
    };
    beside.q = rounded(here_.q, of(&Sizes::q), turns, rounding, q_);
    beside.v = rounded(here_.v, of(&Sizes::v), turns, rounding, v_);
    beside.a = rounded(here_.a, of(&Sizes::a), turns, rounding, a_);
    beside.lambda = rounded(
        here_.lambda, [&](std::size_t k) { return multipliers_[k]; }, turns, rounding, lambda_);
    beside.forces = rounded(
        here_.forces, [&](std::size_t k) { return forces_[k]; }, turns, rounding, slots_);
    beside.energy += rounding * energy_;
    return beside;
  }

 private:
  struct Sizes {
    double q = 0.0, v = 0.0, a = 0.0;
  };

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

  template <class SizeOf>
  static std::span<const double> rounded(std::span<const double> x, const SizeOf& size, std::size_t turns,
                                         double rounding, std::vector<double>& to) {
    to.resize(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double by = rounding * std::max(std::abs(x[i]), size(i));
      to[i] = i / turns % 2 == 0 ? x[i] + by : x[i] - by;
    }
    return to;
  }

  std::shared_ptr<const Layout> layout_;
  std::vector<double> masses_;     ///< of each coordinate, or inertias,
  std::vector<std::size_t> kind_;  ///< and which of the sizes it has
  FlatSample here_;
  std::vector<Sizes> sizes_;                  ///< of lengths and of angles of each island
  std::vector<double> forces_, multipliers_;  ///< how large they are
  double energy_ = 0.0;
  std::vector<double> q_, v_, a_, lambda_, slots_;
};

}  // namespace dalembert
