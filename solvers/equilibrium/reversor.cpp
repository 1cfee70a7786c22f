#include "dalembert/solvers/equilibrium/reversor.h"

#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/errors.h>
#include <dalembert/core/linear/products.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/bodies.h>
#include <dalembert/solvers/equilibrium/mass_metric.h>
#include <dalembert/solvers/equilibrium/nearby_states.h>
#include <dalembert/solvers/manifold/manifold.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// A body or a particle of its own: places as columns, off the centre of its part, and velocities. In the
/// plane z is 0.
struct Piece {
  BodyParticles particles;
  MatrixXd r, v;
  VectorXd share;  ///< of the mass
  double mass;

  Piece(BodyParticles all, const Start& start, int dimension) : particles(std::move(all)), mass(0.0) {
    const auto count = static_cast<Index>(particles.size());
    r = v = MatrixXd::Zero(3, count);
    share.resize(count);
    for (Index i = 0; i < count; ++i) {
      const Layout::Particle& p = *particles[static_cast<std::size_t>(i)];
      for (int k = 0; k < dimension; ++k) {
        r(k, i) = start.q[static_cast<std::size_t>(p.coordinate + k)];
        v(k, i) = start.v[static_cast<std::size_t>(p.coordinate + k)];
      }
      share[i] = p.mass;
    }
    mass = share.sum();
    share /= mass;
  }
  [[nodiscard]] Vector3d centre() const { return r * share; }
  [[nodiscard]] Vector3d velocity() const { return v * share; }
  [[nodiscard]] Vector3d angular_velocity() const {
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    Vector3d momentum = Vector3d::Zero();
    for (Index i = 0; i < r.cols(); ++i) {
      const Vector3d arm = r.col(i) - centre(), speed = v.col(i);
      inertia += share[i] * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
      momentum += share[i] * arm.cross(speed);
    }
    return dense::least_squares(inertia, momentum, rank_threshold);
  }
  /// Weights of sum 1 with sum_j W_ij r_j = M r_i.
  [[nodiscard]] MatrixXd mirrored(const Eigen::Matrix3d& M) const {
    const auto with_unit = [&](const MatrixXd& x) {
      MatrixXd augmented(4, x.cols());
      augmented << x, VectorXd::Constant(x.cols(), r.norm() > 0.0 ? r.norm() : 1.0).transpose();
      return augmented;
    };
    return dense::least_squares(with_unit(r), with_unit(MatrixXd(M) * r), rank_threshold).transpose();
  }
};

/// What of a scene is mirrored together.
class Part {
 public:
  Part(const Problem& problem, const Start& start, std::size_t part)
      : system_(&problem.system()), start_(&start), dimension_(system_->layout()->dimension) {
    const auto& of_coordinate = problem.islands().of_coordinate;
    const auto is_own = [&](int coordinate) {
      return of_coordinate[static_cast<std::size_t>(coordinate)] == part;
    };
    std::vector<char> held(system_->coordinates(), 0);
    for (const BodyParticles& body : bodies(*system_)) {
      for (const Layout::Particle* p : body) held[static_cast<std::size_t>(p->coordinate)] = 1;
      if (is_own(body.front()->coordinate)) pieces_.emplace_back(body, start, dimension_);
    }
    for (const auto& p : system_->layout()->particles)
      if (is_own(p.coordinate) && !held[static_cast<std::size_t>(p.coordinate)])
        pieces_.emplace_back(BodyParticles{&p}, start, dimension_);
    for (const auto& rotor : system_->layout()->rotors)
      if (is_own(rotor.coordinate)) rotors_.push_back(rotor.coordinate);
    double mass = 0.0;
    for (const Piece& piece : pieces_) mass += piece.mass;
    for (const Piece& piece : pieces_) centre_ += piece.mass / mass * piece.centre();
    for (Piece& piece : pieces_) piece.r.colwise() -= centre_;
  }

  /// Along the motion of the centres; where they rest, principal axes that lie across all angular velocities
  /// and across the plane or line of the centres; and 0, of time reversed alone.
  [[nodiscard]] std::vector<Vector3d> normals() const {
    std::vector<Vector3d> all{Vector3d::Zero()};
    Vector3d fastest = Vector3d::Zero();
    double speed = 0.0;
    for (const Piece& piece : pieces_) {
      if (piece.velocity().norm() > fastest.norm()) fastest = piece.velocity();
      speed = std::max(speed, piece.v.cwiseAbs().maxCoeff());
    }
    if (fastest.norm() > rank_threshold * speed) {
      all.emplace_back(fastest.normalized());
      return all;
    }
    const MatrixXd free = across(speed);
    if (free.cols() == 0) return all;
    MatrixXd moments = MatrixXd::Zero(3, 3);
    for (const Piece& piece : pieces_)
      moments += piece.mass * (MatrixXd(piece.r * piece.share.asDiagonal()) * piece.r.transpose());
    const MatrixXd axes = free * dense::symmetric_eigen(dense::restricted(free, moments)).vectors;
    for (Index k = 0; k < axes.cols(); ++k) all.emplace_back(axes.col(k));
    return all;
  }

  /// (1) of the header; an angle at rest is mirrored by a sign.
  [[nodiscard]] Reversor mirror(const Vector3d& n, double sign_at_rest) const {
    const auto all = static_cast<Index>(system_->coordinates());
    Reversor R{MatrixXd::Identity(all, all), MatrixXd::Identity(all, all), VectorXd::Zero(all)};
    const Eigen::Matrix3d M = Eigen::Matrix3d::Identity() - 2.0 * n * n.transpose();
    const Vector3d shift = centre_ - M * centre_;
    for (const Piece& piece : pieces_) {
      const MatrixXd W = piece.mirrored(M);
      for (Index i = 0; i < W.rows(); ++i) {
        const Index at = piece.particles[static_cast<std::size_t>(i)]->coordinate;
        R.b.segment(at, dimension_) = shift.head(dimension_);
        for (Index j = 0; j < W.cols(); ++j) {
          const Index of = piece.particles[static_cast<std::size_t>(j)]->coordinate;
          R.S.block(at, of, dimension_, dimension_) = W(i, j) * M.topLeftCorner(dimension_, dimension_);
          R.V.block(at, of, dimension_, dimension_) = -R.S.block(at, of, dimension_, dimension_);
        }
      }
    }
    const double fastest = largest(start_->v);
    for (const int i : rotors_) {
      const auto k = static_cast<std::size_t>(i);
      const bool turns = std::abs(start_->v[k]) > rank_threshold * fastest;
      R.S(i, i) = turns ? -1.0 : sign_at_rest;
      R.V(i, i) = -R.S(i, i);
      R.b[i] = (1.0 - R.S(i, i)) * start_->q[k];
    }
    return R;
  }
  [[nodiscard]] bool has_rotors() const { return !rotors_.empty(); }

 private:
  [[nodiscard]] MatrixXd across(double speed) const {
    std::vector<Vector3d> lines;
    if (dimension_ == 2) lines.emplace_back(Vector3d::UnitZ());
    for (const Piece& piece : pieces_) {
      if (piece.centre().norm() > rank_threshold * start_->scales.length) lines.push_back(piece.centre());
      const Vector3d w = piece.angular_velocity();
      if (w.norm() * piece.r.norm() > rank_threshold * speed) lines.push_back(w);
    }
    if (lines.empty()) return Eigen::Matrix3d::Identity();
    MatrixXd columns(3, static_cast<Index>(lines.size()));
    for (Index k = 0; k < columns.cols(); ++k)
      columns.col(k) = lines[static_cast<std::size_t>(k)].normalized();
    return orthogonal_complement(columns);
  }

  const System* system_;
  const Start* start_;
  int dimension_;
  std::vector<Piece> pieces_{};
  std::vector<int> rotors_{};
  Vector3d centre_ = Vector3d::Zero();
};

VectorXd as_vector(std::span<const double> x) {
  return Eigen::Map<const VectorXd>(x.data(), static_cast<Index>(x.size()));
}
std::span<const double> numbers(const VectorXd& x) { return {x.data(), static_cast<std::size_t>(x.size())}; }

bool leaves(const Reversor& R, const Start& start) {
  const VectorXd q = as_vector(start.q), v = as_vector(start.v);
  const double close = rank_threshold * start.scales.length;
  return (R.S * q + R.b - q).cwiseAbs().maxCoeff() <= close &&
         (R.V * v - v).cwiseAbs().maxCoeff() <= rank_threshold * largest(start.v);
}

/// The largest sum, without signs, that an acceleration of a part is made of.
double terms(const System& system, const System::Evaluation& e, const NearbyState& s,
             std::span<const char> is_own) {
  std::vector<double> forces(s.a.size());
  for (std::size_t i = 0; i < forces.size(); ++i)
    forces[i] = std::abs(e.force[i]) + system.masses()[i] * std::abs(s.a[i]);
  for (std::size_t r = 0; r < system.rows(); ++r)
    for (const std::size_t k : system.row(r)) forces[system.w_columns()[k]] += std::abs(e.w[k] * s.lambda[r]);
  double most = 0.0;
  for (std::size_t i = 0; i < forces.size(); ++i)
    if (is_own[i]) most = std::max(most, forces[i] / system.masses()[i]);
  return most;
}

/// How far a state is off its constraints, as a part of the scene's length or of its speed.
/// Springs follow.
double violation(const System& system, System::Evaluation& e, const Scales& scales, double speed) {
  for (std::size_t r = 0; r < system.rows(); ++r)
    if (system.law(r).compliant()) e.g[r] = e.psi[r] = 0.0;
  const auto lengths = scales.lengths();
  return std::max(position_violation(system, e, lengths).size / scales.length,
                  velocity_violation(system, e, lengths).size / speed);
}

/// See the header, of a state. Accelerations are known as well as it satisfies the constraints.
bool reverses(const Reversor& R, const Problem& problem, const Start& start, const NearbyState& s,
              std::span<const char> is_own, double later) {
  const System& system = problem.system();
  const VectorXd q = R.S * as_vector(s.q) + R.b, v = R.V * as_vector(s.v);
  const Instant image{later, numbers(q), numbers(v)};
  auto e = system.evaluation();
  system.evaluate(image, e);
  const double off = std::max(epsilon, violation(system, e, start.scales, largest(s.v)));
  if (off > off_constraints) return false;
  std::vector<double> a(s.a.size());
  if (!Manifold(problem, start.rows, start.scales.lengths()).accelerate(image, a)) return false;
  VectorXd reversed = as_vector(s.a);
  for (Index i = 0; i < reversed.size(); ++i)
    if (!is_own[static_cast<std::size_t>(i)]) reversed[i] = a[static_cast<std::size_t>(i)];
  const VectorXd difference = R.S * reversed - as_vector(a);
  return difference.cwiseAbs().maxCoeff() <= roundings_of_a_sum * off * terms(system, e, s, is_own);
}

bool reverses(const Reversor& R, const Problem& problem, const Start& start, double time, std::size_t part) {
  constexpr int samples = 4;
  constexpr double way = 0.2;  // far enough for what is small near the motion to show
  std::vector<char> is_own;
  for (const std::size_t of : problem.islands().of_coordinate) is_own.push_back(of == part);
  for (int number = 1; number <= samples; ++number) {
    const NearbyState s = nearby_state(problem, start, time, number, way);
    if (!reverses(R, problem, start, s, is_own, time + number * start.scales.time)) return false;
  }
  return true;
}

}  // namespace

std::vector<Reversor> reversors(const Problem& problem, const Start& start, double time, std::size_t part) {
  const Part own(problem, start, part);
  std::vector<Reversor> found;
  for (const Vector3d& n : own.normals()) {
    for (const double sign : {-1.0, 1.0}) {
      Reversor R = own.mirror(n, sign);
      if (leaves(R, start) && reverses(R, problem, start, time, part)) found.push_back(std::move(R));
      if (!own.has_rotors()) break;
    }
  }
  return found;
}

}  // namespace dalembert
