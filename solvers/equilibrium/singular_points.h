#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/continuation.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The points of a branch, between two that follow each other, at which its stability may change: where a
/// real eigenvalue of the stiffness changes its sign, and where a vibration begins to grow or ceases to. Of a
/// steady motion, also where something grows that does not vibrate: a flutter of frequency 0.
///
/// Eigenvalues are followed by their shapes and not by their order: of two that change their signs against
/// each other the numbers above and below 0 do not tell. Two shapes are the same if the covector of either
/// gives more than `same_shape` of the other; where that tells too little the step is divided.
class SingularPoints {
 public:
  /// A point where a real eigenvalue is 0, for each that is found to be.
  struct Zero {
    Node at;
    bool turns;                ///< the branch turns back there: a fold
    std::ptrdiff_t count = 1;  ///< how many eigenvalues are 0 there, but not beside it
  };
  struct Flutter {
    Node at;
    double frequency;
  };
  struct Found {
    std::vector<Zero> zeros;
    std::vector<Flutter> flutters;
    bool missed = false;  ///< a change of stability was not located
  };

  SingularPoints(const Corrector& corrector, double step) : corrector_(&corrector), step_(step) {}

  /// Between a and b, `before` a on the branch if there is such a point.
  [[nodiscard]] Found between(const Node* before, const Node& a, const Node& b) const;
  /// Where the parameter turns back between a and b though no eigenvalue changes its sign: a fork, entered
  /// along a branch that touches the hyperplane across the parameter there.
  [[nodiscard]] std::optional<Zero> turning(const Node& a, const Node& b) const;

 private:
  /// An eigenvalue at both ends of a step, by its places there.
  using Pair = std::pair<Eigen::Index, Eigen::Index>;
  struct Followed {
    std::vector<Pair> pairs{};
    std::vector<Eigen::Index> of_a{}, of_b{};  ///< that are not known again
    Eigen::MatrixXd alike{};                   ///< how much each of a is of each of b

    [[nodiscard]] bool matters(const Node& a, const Node& b) const;
    /// By their order, where shapes do not tell.
    void pair_the_rest();
  };
  [[nodiscard]] static Followed follow(const Node& a, const Node& b);
  /// Whether an eigenvalue that heads for 0 at a has the same sign at b: it may have been there and back.
  [[nodiscard]] static bool may_have_turned(const Node* before, const Node& a, const Node& b,
                                            const Followed& followed);
  void zeros(const Node* before, const Node& a, const Node& b, int depth, Found& found) const;
  void flutters(const Node& a, const Node& b, int depth, Found& found) const;

  [[nodiscard]] std::optional<Node> on_chord(const Node& a, const Node& b, double way) const;
  /// What is 0 at the point that is looked for, of any point beside it.
  using Function = std::function<double(const Node&)>;
  [[nodiscard]] std::optional<Zero> locate(const Node& a, const Node& b, Pair pair) const;
  [[nodiscard]] std::optional<Zero> locate_determinant(const Node& a, const Node& b) const;
  [[nodiscard]] std::optional<Zero> nearest(const Node& a, const Node& b, const Function& value) const;
  [[nodiscard]] std::optional<Zero> interpolated(const Node& a, const Node& b, double way, double width,
                                                 const Function& value) const;
  [[nodiscard]] std::optional<Flutter> locate_flutter(const Node& a, const Node& b, std::size_t rank,
                                                      bool& missed) const;

  const Corrector* corrector_;
  double step_;
};

}  // namespace dalembert
