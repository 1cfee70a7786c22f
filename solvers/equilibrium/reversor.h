#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/linear/problem.h>
#include <dalembert/solvers/manifold/start.h>

#include <Eigen/Core>

#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A reversor: a map of states onto each other, its own inverse, that carries motions into motions run
/// backwards. Here a mirror with the reversal of time, of one uncoupled part of a scene,
///
///   q -> S q + b,    v -> V v,                                                                       (1)
///
/// with V = -S in that part; the rest of the scene stays as it is. Of the mirror with the normal n,
/// I - 2 n n^T, S is the image of each particle, and of a body the image in space of its image in itself: as
/// a body's particles are an affine basis of it, a constant matrix that leaves the body where it is.
struct Reversor {
  Eigen::MatrixXd S, V;
  Eigen::VectorXd b;
};

/// Those that leave the state of a part as it is. Where its centres move, n is along their motion: they lie
/// in one plane across n, and angular velocities in it. Whether one is a reversor the equations tell: at
/// generic states near the start its image satisfies the constraints, and has the image S a of the
/// accelerations, at another time too. None if no mirror does.
[[nodiscard]] std::vector<Reversor> reversors(const Problem& problem, const Start& start, double time,
                                              std::size_t part);

}  // namespace dalembert
