#pragma once

#include <dalembert/core/analysis/islands.h>
#include <dalembert/core/analysis/rank.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/linear_terms.h>
#include <dalembert/solvers/equilibrium/normal_modes.h>
#include <dalembert/solvers/manifold/scales.h>

#include <Eigen/Core>

#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A displacement, and a velocity relative to the frame.
struct Disturbance {
  Eigen::VectorXd shift, rate;
};

/// Small motions that do not decay, in each uncoupled part of a scene of size 1: the largest number, of a
/// length in the scene's length.
class UndecayedMotions {
 public:
  /// The arguments must outlive this.
  UndecayedMotions(const System& system, const Islands& parts, const Scales& scales);

  void add(std::size_t part, const Mode& mode) { modes_[part].push_back(&mode); }
  /// The most modes of one part.
  [[nodiscard]] std::size_t most() const;
  /// In each part mode k, if it has as many, at a phase.
  [[nodiscard]] Disturbance alone(std::size_t k, double phase) const;
  /// In each part all modes, at phases that differ from number to number.
  [[nodiscard]] Disturbance together(int number) const;
  /// Of no special kind, and nothing that linear terms damp: in some of many each coordinate is among the
  /// largest.
  [[nodiscard]] Disturbance undamped(const LinearTerms& terms, const ActiveRows& rows, unsigned number) const;

  /// The largest number of each part.
  [[nodiscard]] std::vector<double> sizes(const Eigen::VectorXd& x) const;
  /// One number per coordinate: 1 of an angle, else the scene's length.
  [[nodiscard]] const Eigen::VectorXd& units() const { return units_; }

 private:
  void add(const Mode& mode, double phase, double part, Disturbance& to) const;
  [[nodiscard]] Disturbance nothing() const;
  [[nodiscard]] Eigen::VectorXd of_size_1(Eigen::VectorXd x) const;

  const System* system_;
  const Islands* parts_;
  double time_;
  Eigen::VectorXd units_;
  std::vector<std::vector<const Mode*>> modes_;
};

}  // namespace dalembert
