#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/erk/combination.h>
#include <dalembert/solvers/erk/node.h>
#include <dalembert/solvers/erk/verner.h>
#include <dalembert/solvers/manifold/scales.h>

#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The stages of one step of the pair: the states there, and the derivatives that combine into the next one.
/// The first stage is the node at which the step starts.
class ErkStepper::Stages {
 public:
  static constexpr const ButcherTable<13>& pair = verner87;
  static constexpr std::size_t count = pair.stages;
  using Derivatives = Combination<pair.stages>::Derivatives;
  struct Stage {
    std::span<double> q, v, a;
  };

  explicit Stages(std::size_t coordinates);

  void start(const Node& at) { k_[0] = at.v().data(); }
  /// Stage i > 0.
  [[nodiscard]] Stage operator[](std::size_t i) {
    const auto x = std::span(after_first_).subspan((i - 1) * 3 * n_, 3 * n_);
    return {x.first(n_), x.subspan(n_, n_), x.subspan(2 * n_, n_)};
  }
  /// Moves stage i > 0 of a step by h to where those before it lead.
  void move(std::size_t i, const Node& start, double h) {
    a_[i].move(h, k_, start.x.data(), (*this)[i].q.data(), 2 * n_);
  }
  /// Where all of them lead.
  void finish(const Node& start, double h, Node& end) const;
  /// Of positions and velocities, at each stage.
  [[nodiscard]] const Derivatives& derivatives() const { return k_; }
  /// Whether stability limits a step by h, rather than accuracy.
  [[nodiscard]] bool at_limit_of_stability(double h, const Scales& scales) const;

 private:
  std::size_t n_;
  std::vector<Combination<pair.stages>> a_;
  Combination<pair.stages> b_{pair.b};
  std::vector<double> after_first_;
  Derivatives k_{};
};

}  // namespace dalembert
