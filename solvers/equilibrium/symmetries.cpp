#include "dalembert/solvers/equilibrium/symmetries.h"

#include <dalembert/core/analysis/rank.h>
#include <dalembert/core/linear/products.h>
#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/equilibrium/bodies.h>
#include <dalembert/solvers/equilibrium/linear_terms.h>
#include <dalembert/solvers/equilibrium/mass_metric.h>
#include <dalembert/solvers/equilibrium/nearby_states.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dalembert {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Triplets = std::vector<Eigen::Triplet<double>>;

Eigen::Matrix3d cross_matrix(const Vector3d& w) {
  Eigen::Matrix3d m;
  m << 0.0, -w.z(), w.y(), w.z(), 0.0, -w.x(), -w.y(), w.x(), 0.0;
  return m;
}

Vector3d place(const Start& start, int coordinate, int dimension) {
  Vector3d r = Vector3d::Zero();
  for (int i = 0; i < dimension; ++i) r[i] = start.q[static_cast<std::size_t>(coordinate + i)];
  return r;
}

/// The axes about which something rotates in a space of this dimension.
std::vector<Vector3d> axes_of_rotation(int dimension) {
  if (dimension == 2) return {Vector3d::UnitZ()};
  return {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
}

/// Weights S with sum_j S_ij r_j = axis x (r_i - c), sum_j S_ij = 0: c the centre of mass. A lamina's are
/// found in its plane, for its normal only; a plane body's need the rotation beside the weights.
MatrixXd spin_weights(const MatrixXd& arms, const Vector3d& axis) {
  MatrixXd augmented(4, arms.cols());
  augmented << arms, VectorXd::Constant(arms.cols(), arms.norm()).transpose();
  MatrixXd turned = MatrixXd::Zero(4, arms.cols());
  turned.topRows(3) = MatrixXd(cross_matrix(axis)) * arms;
  return dense::least_squares(augmented, turned, rank_threshold).transpose();
}

}  // namespace

Symmetries::Symmetries(const Problem& problem, const Start& start, double time)
    : units_(static_cast<Index>(start.q.size())), parts_(problem.islands()) {
  for (Index i = 0; i < units_.size(); ++i) units_[i] = start.scales.unit(static_cast<std::size_t>(i));
  add_parts(problem, start);
  add_bodies(problem.system(), start);
  // Generic states: each gives as many conditions as the scene is free. The first at rest, where fast spins
  // do not hide what is soft.
  constexpr int samples = 4;
  const auto count = static_cast<Index>(generators_.size());
  MatrixXd all(0, count);
  for (int sample = 0; sample < samples; ++sample) {
    const MatrixXd own = conditions(problem, start, time, sample);
    all = dense::below(all, own);
  }
  const auto [values, vectors] = dense::symmetric_eigen(all.transpose() * all);
  // Squares: what is 1e-9 of its terms, of a condition whose terms are 1.
  Index zero = 0;
  while (zero < count && values[zero] < rank_threshold * rank_threshold * static_cast<double>(all.rows()))
    ++zero;
  // Once more at the precision of the conditions, not of their squares.
  basis_ = dense::kernel_within(all, rank_threshold);
  if (basis_.cols() != zero && basis_.cols() == 0) basis_ = vectors.leftCols(zero);
  if (basis_.cols() > 0) basis_ = orthogonal_complement(orthogonal_complement(basis_));
}

Symmetries::Generator Symmetries::generator(const Start& start, bool turns, bool rotates) {
  const auto n = static_cast<Index>(start.q.size());
  return {{n, n}, VectorXd::Zero(n), Eigen::Map<const VectorXd>(start.q.data(), n), turns, rotates};
}

void Symmetries::add_parts(const Problem& problem, const Start& start) {
  const System& system = problem.system();
  const Layout& layout = *system.layout();
  const Islands& parts = problem.islands();
  const int d = layout.dimension;
  const auto part_of = [&](int coordinate) {
    return parts.of_coordinate[static_cast<std::size_t>(coordinate)];
  };
  for (std::size_t part = 0; part < parts.count; ++part) {
    Vector3d centre = Vector3d::Zero();
    double many = 0.0;
    for (const auto& p : layout.particles) {
      if (part_of(p.coordinate) != part) continue;
      centre += place(start, p.coordinate, d);
      many += 1.0;
    }
    if (many == 0.0) continue;
    centre /= many;
    for (int i = 0; i < d; ++i) {
      Generator x = generator(start, false, false);
      for (const auto& p : layout.particles)
        if (part_of(p.coordinate) == part) x.b[p.coordinate + i] = start.scales.length;
      generators_.push_back(std::move(x));
    }
    for (const Vector3d& axis : axes_of_rotation(d)) {
      Generator x = generator(start, true, true);
      const Eigen::Matrix3d cross = cross_matrix(axis);
      Triplets entries;
      for (const auto& p : layout.particles) {
        if (part_of(p.coordinate) != part) continue;
        for (int i = 0; i < d; ++i) {
          x.c[p.coordinate + i] = centre[i];
          for (int k = 0; k < d; ++k)
            if (cross(i, k) != 0.0) entries.emplace_back(p.coordinate + i, p.coordinate + k, cross(i, k));
        }
      }
      x.A.setFromTriplets(entries.begin(), entries.end());
      generators_.push_back(std::move(x));
    }
  }
  for (const auto& rotor : layout.rotors) {
    Generator x = generator(start, false, true);
    x.b[rotor.coordinate] = 1.0;
    generators_.push_back(std::move(x));
  }
}

void Symmetries::add_bodies(const System& system, const Start& start) {
  const int d = system.layout()->dimension;
  for (const BodyParticles& body : bodies(system)) {
    const auto count = static_cast<Index>(body.size());
    if (count < d) continue;  // a rod in space: it does not turn in itself
    MatrixXd arms(3, count);
    VectorXd share(count);
    for (Index i = 0; i < count; ++i) {
      arms.col(i) = place(start, body[static_cast<std::size_t>(i)]->coordinate, d);
      share[i] = body[static_cast<std::size_t>(i)]->mass;
    }
    share /= share.sum();
    const Vector3d centre = arms * share;
    arms.colwise() -= centre;
    const auto add = [&](const MatrixXd& S, const Eigen::Matrix3d& R) {
      Triplets entries;
      for (Index i = 0; i < count; ++i) {
        for (Index j = 0; j < count; ++j) {
          for (int k = 0; k < d; ++k) {
            for (int l = 0; l < d; ++l)
              if (R(k, l) != 0.0)
                entries.emplace_back(body[static_cast<std::size_t>(i)]->coordinate + k,
                                     body[static_cast<std::size_t>(j)]->coordinate + l, S(i, j) * R(k, l));
          }
        }
      }
      Generator x = generator(start, false, true);
      for (const Layout::Particle* p : body) x.c.segment(p->coordinate, d) = centre.head(d);
      x.A.setFromTriplets(entries.begin(), entries.end());
      generators_.push_back(std::move(x));
    };
    if (d == 2) {
      add(MatrixXd::Identity(count, count) - VectorXd::Ones(count) * share.transpose(),
          cross_matrix(Vector3d::UnitZ()));
    } else if (count == 3) {
      add(spin_weights(
              arms,
              Vector3d(arms.col(1) - arms.col(0)).cross(Vector3d(arms.col(2) - arms.col(0))).normalized()),
          Eigen::Matrix3d::Identity());
    } else if (count == 4) {
      for (const Vector3d& axis : axes_of_rotation(d))
        add(spin_weights(arms, axis), Eigen::Matrix3d::Identity());
    }
  }
}

/// (2) of the header at a state near the start. Each row is divided by the largest sum of its terms' sizes.
MatrixXd Symmetries::conditions(const Problem& problem, const Start& start, double time, int sample) const {
  const System& system = problem.system();
  const auto n = static_cast<Index>(system.coordinates()), count = static_cast<Index>(generators_.size());
  // Far enough for what is not symmetric to show, near enough to be brought onto the constraints.
  constexpr double way = 0.05;
  const auto [q, v, a, lambda] = nearby_state(problem, start, time, sample, way);
  const UniformMotion rest{{n, n}, VectorXd::Zero(n)};
  const LinearTerms terms = linear_terms(system, RotatingFrame(rest), {time, q, v}, lambda);
  std::vector<std::size_t> all(system.coordinates()), rows(system.rows());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  const MassMetric metric(system, terms, all, rows);
  const MatrixXd N = orthogonal_complement(metric.W.transpose());
  const VectorXd at = Eigen::Map<const VectorXd>(q.data(), n),
                 speed = Eigen::Map<const VectorXd>(v.data(), n),
                 acceleration = Eigen::Map<const VectorXd>(a.data(), n), to = metric.root.cwiseInverse();
  const Index m = metric.W.rows(), h = metric.holonomic;
  const MatrixXd W_h = metric.W.topRows(h), W_v = metric.W.bottomRows(m - h), E = metric.E.bottomRows(m - h),
                 N_t = N.transpose();
  const MatrixXd W_h_size = dense::sizes(W_h), W_v_size = dense::sizes(W_v), E_size = dense::sizes(E),
                 N_t_size = dense::sizes(N_t), K_size = dense::sizes(metric.K),
                 C_size = dense::sizes(metric.C);
  MatrixXd value(m + N.cols(), count), size = value;
  for (Index k = 0; k < count; ++k) {
    const Generator& g = generators_[static_cast<std::size_t>(k)];
    const VectorXd X = to.cwiseProduct(g.at(at)), u = to.cwiseProduct(g.A * speed),
                   w = to.cwiseProduct(g.A * acceleration);
    value.col(k) << W_h * X, E * X + W_v * u, -(N_t * VectorXd(metric.K * X + metric.C * u + w));
    const VectorXd X1 = X.cwiseAbs(), u1 = u.cwiseAbs(), w1 = w.cwiseAbs();
    size.col(k) << W_h_size * X1, E_size * X1 + W_v_size * u1,
        N_t_size * VectorXd(K_size * X1 + C_size * u1 + w1);
  }
  // What no force acts on has accelerations of round-off: they tell nothing.
  const Scales& scales = start.scales;
  const double least =
      roundings_of_a_sum * epsilon * to.cwiseProduct(units_).maxCoeff() / (scales.time * scales.time);
  for (Index r = 0; r < value.rows(); ++r) {
    const double most = size.row(r).maxCoeff();
    value.row(r) *= most > (r < m ? 0.0 : least) ? 1.0 / most : 0.0;
  }
  return value;
}

UniformMotion Symmetries::motion(const VectorXd& y) const {
  const VectorXd c = basis_ * y;
  const Index n = generators_.empty() ? 0 : generators_.front().b.size();
  UniformMotion sum{{n, n}, VectorXd::Zero(n)};
  for (Index k = 0; k < c.size(); ++k) {
    const Generator& g = generators_[static_cast<std::size_t>(k)];
    if (c[k] == 0.0) continue;
    sum.A += c[k] * g.A;
    sum.b += c[k] * (g.b - g.A * g.c);
    if (g.rotates) sum.rate = std::max(sum.rate, std::abs(c[k]));
  }
  return sum;
}

MatrixXd Symmetries::commuting(const VectorXd& q, const VectorXd& y) const {
  return commuting(q, RotatingFrame(motion(y)));
}

MatrixXd Symmetries::commuting(const VectorXd& q, const RotatingFrame& frame) const {
  const RotatingFrame::Sparse& A = frame.matrix();
  VectorXd v(q.size());
  frame.velocity({q.data(), static_cast<std::size_t>(q.size())},
                 {v.data(), static_cast<std::size_t>(q.size())});
  const VectorXd a = A * v;
  const MatrixXd X = fields(q), Av = images(v), AX = A * X, AAv = A * Av, Aa = images(a);
  MatrixXd value = dense::below(Av - AX, Aa - AAv);
  const RotatingFrame::Sparse size_of_A = A.cwiseAbs();
  const MatrixXd X1 = dense::sizes(X), Av1 = dense::sizes(Av), Aa1 = dense::sizes(Aa);
  const MatrixXd terms = dense::below(Av1 + size_of_A * X1, Aa1 + size_of_A * Av1);
  // Rows of one kind are compared in units of the scene: a row of round-off is measured by the largest.
  const VectorXd per_unit = units_.cwiseInverse();
  for (const Index first : {Index{0}, q.size()}) {
    auto own = value.middleRows(first, q.size());
    const MatrixXd sizes = per_unit.asDiagonal() * terms.middleRows(first, q.size());
    own = (per_unit.asDiagonal() * own).eval();
    if (const double most = sizes.size() > 0 ? sizes.maxCoeff() : 0.0; most > 0.0) own /= most;
  }
  return dense::kernel_within(value, rank_threshold);
}

MatrixXd Symmetries::displacements(const VectorXd& q, const MatrixXd& some) const {
  const MatrixXd coefficients = basis_ * some;
  MatrixXd X = fields(q) * some;
  // Differences are known to round-off of the positions.
  const double rounding = roundings_of_a_sum * epsilon / rank_threshold;
  VectorXd sizes = VectorXd::Zero(q.size());
  for (const Generator& g : generators_)
    sizes += RotatingFrame::Sparse(g.A.cwiseAbs()) * ((q - g.c).cwiseAbs() + rounding * q.cwiseAbs()) +
             g.b.cwiseAbs();
  for (Index k = 0; k < X.cols(); ++k) {
    const double least = rank_threshold * coefficients.col(k).cwiseAbs().maxCoeff();
    std::vector<char> displaced(parts_.count);
    const auto part = [this](Index i) { return parts_.of_coordinate[static_cast<std::size_t>(i)]; };
    for (Index i = 0; i < X.rows(); ++i)
      if (std::abs(X(i, k)) > least * sizes[i]) displaced[part(i)] = 1;
    for (Index i = 0; i < X.rows(); ++i)
      if (!displaced[part(i)]) X(i, k) = 0.0;
  }
  return X;
}

MatrixXd Symmetries::fields(const VectorXd& q) const {
  MatrixXd all(q.size(), static_cast<Index>(generators_.size()));
  for (Index k = 0; k < all.cols(); ++k) {
    all.col(k) = generators_[static_cast<std::size_t>(k)].at(q);
  }
  return all * basis_;
}

MatrixXd Symmetries::images(const VectorXd& x) const {
  MatrixXd all(x.size(), static_cast<Index>(generators_.size()));
  for (Index k = 0; k < all.cols(); ++k) all.col(k) = generators_[static_cast<std::size_t>(k)].A * x;
  return all * basis_;
}

MatrixXd Symmetries::turning() const {
  MatrixXd all = MatrixXd::Zero(static_cast<Index>(generators_.size()), basis_.cols());
  for (Index k = 0; k < all.rows(); ++k)
    if (generators_[static_cast<std::size_t>(k)].turns) all.row(k) = basis_.row(k);
  return all;
}

MatrixXd orthonormal_span(MatrixXd columns) {
  Index count = 0;
  for (Index k = 0; k < columns.cols(); ++k)
    if (const double length = columns.col(k).norm(); length > 0.0)
      columns.col(count++) = (columns.col(k) / length).eval();
  if (count == 0) return {columns.rows(), 0};
  columns.conservativeResize(Eigen::NoChange, count);
  return dense::orthonormal(columns, count - dense::kernel(columns, rank_threshold).cols());
}

}  // namespace dalembert
