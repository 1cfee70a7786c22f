#include "dalembert/view/body_boxes.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dalembert {

namespace {

using Places3 = Eigen::Matrix3Xd;

/// Groups of particles that internal constraints hold together.
std::vector<std::vector<int>> groups_of_particles(const Layout& layout) {
  std::vector<std::size_t> leader(layout.particles.size());
  std::iota(leader.begin(), leader.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (leader[i] != i) i = leader[i] = leader[leader[i]];
    return i;
  };
  std::vector<char> inside(leader.size());
  for (const auto& constraint : layout.constraints) {
    if (!constraint.internal) continue;
    std::size_t first = leader.size();
    for (const std::size_t slot : constraint.slots()) {
      const auto* particle = layout.particle_at(layout.slot_coordinate[slot]);
      if (particle == nullptr) continue;
      const auto i = static_cast<std::size_t>(particle - layout.particles.data());
      inside[i] = 1;
      if (first == leader.size()) first = i;
      leader[find(i)] = find(first);
    }
  }
  std::vector<std::vector<int>> groups;
  std::vector<std::size_t> group_of(leader.size(), leader.size());
  for (std::size_t i = 0; i < leader.size(); ++i) {
    if (!inside[i]) continue;
    std::size_t& its = group_of[find(i)];
    if (its == leader.size()) {
      its = groups.size();
      groups.emplace_back();
    }
    groups[its].push_back(static_cast<int>(i));
  }
  return groups;
}

/// One body at one instant, from which its maps follow: they are the same at all others.
class BoxOfBody {
 public:
  BoxOfBody(const Layout& layout, const FlatSample& at, const std::vector<int>& particles)
      : layout_(layout), at_(at), particles_(particles), places_(3, particles.size()) {
    places_.setZero();
    masses_.resize(static_cast<Eigen::Index>(particles.size()));
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const auto& p = layout.particles[static_cast<std::size_t>(particles[i])];
      masses_[static_cast<Eigen::Index>(i)] = p.mass;
      for (int k = 0; k < layout.dimension; ++k) {
        coordinates_.push_back(p.coordinate + k);
        places_(k, static_cast<Eigen::Index>(i)) = at.q[static_cast<std::size_t>(p.coordinate + k)];
      }
    }
    weights_ = masses_ / masses_.sum();
    centre_ = places_ * weights_;
    arms_ = places_.colwise() - centre_;
  }

  [[nodiscard]] BodyBox box() const {
    BodyBox box{
        .name = name(), .particles = particles_, .centre = by_weights(weights_), .axes = {}, .touched = {}};
    box.centre.direction = false;
    find_touched(box.touched);
    if (layout_.dimension == 2 && particles_.size() == 2) {
      in_the_plane(box);
    } else {
      in_space(box.axes);
    }
    return box;
  }

 private:
  /// What its particles' names have in common.
  [[nodiscard]] std::string name() const {
    const std::string& first = layout_.particles[static_cast<std::size_t>(particles_.front())].name;
    return first.substr(0, first.rfind('.'));
  }
  /// A point whose place is a mean of the particles' places, or a direction if the weights add up to 0.
  [[nodiscard]] SketchedPoint by_weights(const Eigen::VectorXd& weights) const {
    return mapped(weights, Eigen::VectorXd::Zero(weights.size()));
  }
  /// sum w_i r_i + u_i (r_i turned left), which in the plane is any point of the body.
  [[nodiscard]] SketchedPoint mapped(const Eigen::VectorXd& w, const Eigen::VectorXd& u) const {
    const int D = layout_.dimension;
    SketchedPoint point;
    point.coordinates = coordinates_;
    for (int row = 0; row < D; ++row)
      for (Eigen::Index i = 0; i < w.size(); ++i)
        for (int k = 0; k < D; ++k)
          point.map.push_back(row == k ? w[i] : D == 2 ? (row == 0 ? -u[i] : u[i]) : 0.0);
    point.direction = true;
    return point;
  }

  void find_touched(std::vector<SketchedPoint>& touched) const {
    const auto look = [&](const auto& element) {
      if (!element.drawing) return;
      for (const SketchedPoint& point : element.drawing->points)
        if (!point.direction && !point.map.empty() && point.coordinates == coordinates_)
          touched.push_back(point);
    };
    std::ranges::for_each(layout_.constraints, look);
    std::ranges::for_each(layout_.forces, look);
  }

  /// With d from one particle to the other, e = d/|d|: the box along e and e turned left.
  void in_the_plane(BodyBox& box) const {
    const Eigen::Vector3d d = places_.col(1) - places_.col(0), e = d.normalized(), n(-e.y(), e.x(), 0.0);
    const double square = 3.0 * weights_.dot(arms_.colwise().squaredNorm().transpose());
    Eigen::Array2d h = Eigen::Array2d::Zero();
    for (const SketchedPoint& point : box.touched) {
      Eigen::Vector3d r = -centre_;
      for (std::size_t row = 0; row < 2; ++row)
        for (std::size_t k = 0; k < coordinates_.size(); ++k)
          r[static_cast<Eigen::Index>(row)] +=
              point.map[row * coordinates_.size() + k] * at_.q[static_cast<std::size_t>(coordinates_[k])];
      h = h.max(Eigen::Array2d(std::abs(e.dot(r)), std::abs(n.dot(r))));
    }
    const double reach = h.matrix().squaredNorm();
    constexpr double round_off = 1e-9;
    const Eigen::Index longer = h[0] >= h[1] ? 0 : 1;
    if (reach > square * (1.0 + round_off) || reach == 0.0) {
      h.setConstant(std::sqrt(square / 2.0));
    } else {
      h[1 - longer] = std::sqrt(std::max(0.0, square - h[longer] * h[longer]));
    }
    const Eigen::Vector2d along(-1.0, 1.0), none = Eigen::Vector2d::Zero();
    const Eigen::Array2d per = h / d.norm();
    if (h[0] * h[0] > round_off * square) box.axes.push_back(mapped(per[0] * along, none));
    if (h[1] * h[1] > round_off * square) box.axes.push_back(mapped(none, per[1] * along));
  }

  /// The principal axes of the particles; a direction x among them is sum_i (m_i arm_i . S^-1 x) r_i.
  void in_space(std::vector<SketchedPoint>& axes) const {
    const Eigen::Matrix3d S = arms_ * weights_.asDiagonal() * arms_.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(S);
    for (Eigen::Index k = 2; k >= 0; --k) {
      const double moment = principal.eigenvalues()[k];
      if (moment < 1e-12 * principal.eigenvalues()[2]) continue;  // a lamina's, a rod's
      const Eigen::Vector3d e = principal.eigenvectors().col(k);
      const Eigen::VectorXd of = weights_.cwiseProduct(arms_.transpose() * e) / moment;
      axes.push_back(by_weights(std::sqrt(3.0 * moment) * of));
    }
  }

  const Layout& layout_;
  const FlatSample& at_;
  const std::vector<int>& particles_;
  Places3 places_, arms_;
  Eigen::VectorXd masses_, weights_;
  Eigen::Vector3d centre_;
  std::vector<int> coordinates_;
};

}  // namespace

std::vector<BodyBox> body_boxes(const Layout& layout, const FlatSample& at) {
  std::vector<BodyBox> all;
  for (const auto& particles : groups_of_particles(layout))
    all.push_back(BoxOfBody(layout, at, particles).box());
  return all;
}

}  // namespace dalembert
