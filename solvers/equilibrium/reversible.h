#pragma once

#include <dalembert/core/results/sample.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/equilibrium/uniform_motion.h>
#include <dalembert/solvers/linear/problem.h>

#include <map>

namespace DALEMBERT_HIDDEN dalembert {

/// Whether steady motions of parts of a scene are stable since they are reversible, where no energy tells: a
/// disk that rolls above its critical spin. (R. L. Devaney, Reversible diffeomorphisms and flows, Trans. AMS
/// 218, 1976.)
///
/// Theorem. Let a reversor R leave a motion's state as it is, and no symmetry but the identity, near it, do
/// so. On the states up to symmetries the motion is a point of rest, f = 0. If there R = 1, then f = 0 at
/// all: each state near is one of a steady motion. If R = -1 along one line, then f' has one pair of
/// eigenvalues and 0 otherwise; and if the pair is +-i omega, omega > 0, the motion is stable up to
/// symmetries.
///
/// Proof. As f(R x) = -R f(x), f' maps the line to multiples of a b = R b, and all x = R x by some c(x) to
/// the line. It has rank 2, and its square on the line is c(b) = -omega^2. Where x = R x, f(x) lies on the
/// line: it is one function h there, with h' = c, not 0. So the points of rest h = 0 are a manifold E of two
/// dimensions less than the space, to which all zeros belong. What is close to E turns about it with nearly
/// omega, and its distance changes in a turn by little of itself. The surface x = R x contains E, so each
/// orbit crosses it twice in about a turn, first in x, then in y. From y = R y on it is R of its way from x,
/// run backwards, to x = R x: closed, and so it stays near.
class ReversibleMotion {
 public:
  /// The sample, a view, and the motion must outlive this.
  ReversibleMotion(const Problem& problem, const FlatSample& at, const UniformMotion& motion);

  /// Whether the theorem says so of a part; once found it is kept. False where no reversor is found. (Terms
  /// below some 1e-10 of the accelerations are not seen to break it.)
  [[nodiscard]] bool is_stable(std::size_t part);
  /// Whether it has said so of any.
  [[nodiscard]] bool decided() const;

 private:
  [[nodiscard]] bool find(std::size_t part) const;

  Problem problem_;
  FlatSample at_;
  const UniformMotion* motion_;
  std::map<std::size_t, bool> found_{};
};

}  // namespace dalembert
