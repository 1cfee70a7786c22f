#pragma once

#include <dalembert/core/results/layout.h>
#include <dalembert/core/results/sample.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/base/numbers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A sample of which every number is a rounding beside that of another one. A number may be 0 because others
/// cancel, so it is rounded as the largest of its kind is, where that is larger than itself: of lengths or
/// angles, their rates and accelerations, and the forces there.
class RoundedSample {
 public:
  explicit RoundedSample(const Layout& layout)
      : slot_coordinate_(layout.slot_coordinate), masses_(layout.coordinates()), angle_(masses_.size()) {
    for (const Layout::Particle& p : layout.particles)
      for (int i = 0; i < layout.dimension; ++i) masses_[static_cast<std::size_t>(p.coordinate + i)] = p.mass;
    for (const Layout::Rotor& r : layout.rotors) {
      masses_[static_cast<std::size_t>(r.coordinate)] = r.inertia;
      angle_[static_cast<std::size_t>(r.coordinate)] = 1;
    }
    for (const Layout::Constraint& c : layout.constraints) rows_.push_back({c.own_rows(), c.slots()});
  }

  /// The time is that of the scene.
  void measure(const FlatSample& at, double time) {
    here_ = at;
    sizes_ = {};
    sizes_[1].q = 1.0;
    for (std::size_t i = 0; i < masses_.size(); ++i) {
      Sizes& its = sizes_[angle_[i]];
      its.v = std::max(its.v, std::abs(at.v[i]));
      its.q = std::max({its.q, std::abs(at.q[i]), time * std::abs(at.v[i])});
    }
    for (Sizes& its : sizes_) its.a = (its.v = std::max(its.v, its.q / time)) / time;
    for (std::size_t i = 0; i < masses_.size(); ++i)
      sizes_[angle_[i]].a = std::max(sizes_[angle_[i]].a, std::abs(at.a[i]));
    forces_.assign(at.forces.size(), 0.0);
    for (std::size_t k = 0; k < forces_.size(); ++k) {
      const auto i = static_cast<std::size_t>(slot_coordinate_[k]);
      forces_[k] = std::max(masses_[i] * sizes_[angle_[i]].a, std::abs(at.forces[k]));
    }
    measure_multipliers();
  }

  /// Each number up or down, by turns of so many.
  [[nodiscard]] FlatSample by_turns(std::size_t turns) {
    FlatSample beside = here_;
    const auto of = [&](double Sizes::*kind) {
      return [this, kind](std::size_t i) { return sizes_[angle_[i]].*kind; };
    };
    beside.q = rounded(here_.q, of(&Sizes::q), turns, q_);
    beside.v = rounded(here_.v, of(&Sizes::v), turns, v_);
    beside.a = rounded(here_.a, of(&Sizes::a), turns, a_);
    beside.lambda = rounded(
        here_.lambda, [&](std::size_t k) { return multipliers_[k]; }, turns, lambda_);
    beside.forces = rounded(
        here_.forces, [&](std::size_t k) { return forces_[k]; }, turns, slots_);
    return beside;
  }

 private:
  struct Sizes {
    double q = 0.0, v = 0.0, a = 0.0;
  };
  struct Rows {
    Places own, slots;
  };

  /// What a multiplier is in units of its forces is told by these, however small they are; where both are 0
  /// nothing is known.
  void measure_multipliers() {
    multipliers_.assign(here_.lambda.size(), 0.0);
    for (const Rows& c : rows_) {
      double multiplier = 0.0, force = 0.0, size = 0.0;
      for (const std::size_t k : c.own) multiplier = std::max(multiplier, std::abs(here_.lambda[k]));
      for (const std::size_t k : c.slots) {
        force = std::max(force, std::abs(here_.forces[k]));
        size = std::max(size, forces_[k]);
      }
      for (const std::size_t k : c.own)
        multipliers_[k] = force > 0.0 ? size / force * multiplier : multiplier;
    }
  }

  template <class SizeOf>
  static std::span<const double> rounded(std::span<const double> x, const SizeOf& size, std::size_t turns,
                                         std::vector<double>& to) {
    to.resize(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double rounding = epsilon * std::max(std::abs(x[i]), size(i));
      to[i] = i / turns % 2 == 0 ? x[i] + rounding : x[i] - rounding;
    }
    return to;
  }

  std::vector<int> slot_coordinate_;
  std::vector<double> masses_;      ///< of each coordinate, or inertias,
  std::vector<std::size_t> angle_;  ///< and 1 for an angle, else 0
  std::vector<Rows> rows_;
  FlatSample here_;
  std::array<Sizes, 2> sizes_;                ///< of lengths and of angles
  std::vector<double> forces_, multipliers_;  ///< how large they are
  std::vector<double> q_, v_, a_, lambda_, slots_;
};

}  // namespace dalembert
