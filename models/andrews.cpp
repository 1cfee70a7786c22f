#include "dalembert/models/andrews.h"

#include <dalembert/models/minimal_ode.h>
#include <dalembert/models/numbered.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <utility>

namespace dalembert::models {

namespace {

using PlaneVector = VecOf<Real, 2>;
constexpr std::size_t count = 7;

/// The link at whose second joint each begins; -1: at a fixed point.
constexpr std::array<int, count> parent = {-1, 0, -1, 4, -1, 6, -1};

std::array<Vec<2>, count> fixed_points(const Andrews& a) {
  return {Vec<2>::Zero(), Vec<2>::Zero(), a.B, a.A, a.A, a.A, a.A};
}

/// A point with its derivatives by the angles and its acceleration at theta'' = 0.
struct PointMotion {
  PlaneVector r;
  Eigen::Matrix<Real, 2, 7> slope = Eigen::Matrix<Real, 2, 7>::Zero();
  PlaneVector bias = PlaneVector::Zero();

  void add(std::size_t link, const Vec<2>& s, const State& y) {
    const Real sine = std::sin(y[link]), cosine = std::cos(y[link]), rate = y[count + link];
    const PlaneVector arm(cosine * s.x() - sine * s.y(), sine * s.x() + cosine * s.y());
    r += arm;
    slope.col(static_cast<int>(link)) += PlaneVector(-arm.y(), arm.x());
    bias -= rate * rate * arm;
  }
};

/// A point of a link, given in its axes.
PointMotion motion(const Andrews& a, std::size_t link, const Vec<2>& s, const State& y) {
  PointMotion p{.r = fixed_points(a)[link].cast<Real>()};
  if (parent[link] >= 0) {
    const auto before = static_cast<std::size_t>(parent[link]);
    p.add(before, a.links[before].joint, y);
  }
  p.add(link, s, y);
  return p;
}
PointMotion joint_motion(const Andrews& a, std::size_t link, const State& y) {
  return motion(a, link, a.links[link].joint, y);
}

State at_rest(const Andrews& a) {
  State y(2 * count, 0);
  for (std::size_t k = 0; k < count; ++k) y[k] = a.links[k].angle;
  return y;
}

/// theta'' and then the forces at E.
VecOf<Real, 13> solve_motion(const Andrews& a, const State& y) {
  Eigen::Matrix<Real, 13, 13> K = Eigen::Matrix<Real, 13, 13>::Zero();
  Eigen::Matrix<Real, 13, 1> b = Eigen::Matrix<Real, 13, 1>::Zero();
  for (std::size_t k = 0; k < count; ++k) {
    const AndrewsLink& link = a.links[k];
    const PointMotion centre = motion(a, k, link.centre, y);
    K.topLeftCorner<7, 7>() += centre.slope.transpose() * (link.mass * centre.slope);
    K(static_cast<int>(k), static_cast<int>(k)) += link.inertia;
    b.head<7>() -= link.mass * (centre.slope.transpose() * centre.bias);
  }
  b[0] += a.torque;
  const PointMotion D = motion(a, 2, a.D, y);
  const PlaneVector spring = D.r - a.C.cast<Real>();
  const Real l = spring.norm();
  b.head<7>() -= D.slope.transpose() * (a.stiffness * (l - a.relaxed_length) / l * spring);

  const PointMotion E2 = joint_motion(a, 1, y);
  int row = 7;
  for (const std::size_t link : {2U, 3U, 5U}) {
    const PointMotion E = joint_motion(a, link, y);
    K.block<2, 7>(row, 0) = E.slope - E2.slope;
    K.block<7, 2>(0, row) = -(E.slope - E2.slope).transpose();
    b.segment<2>(row) = Eigen::Matrix<Real, 2, 1>(E2.bias - E.bias);
    row += 2;
  }
  return K.partialPivLu().solve(b);
}

Observation<2> observation(const Andrews& a, const State& y) {
  const VecOf<Real, 13> solved = solve_motion(a, y);
  Observation<2> seen;
  for (std::size_t k = 0; k < count; ++k) seen.positions.push_back(joint_motion(a, k, y).r.cast<double>());
  for (int i = 7; i < 13; ++i) seen.forces.push_back(static_cast<double>(solved[i]));
  return seen;
}

}  // namespace

std::array<AndrewsLink, 7> Andrews::published_links() {
  constexpr double beta = -0.0617138900142764496, Theta = 0.0, gamma = 0.455279819163070380,
                   phi = 0.222668390165885885, delta = 0.487364979543842550, Omega = -phi,
                   epsilon = 1.23054744454982119;
  constexpr double d = 0.028, da = 0.0115, e = 0.02, ea = 0.01421, rr = 0.007, ra = 0.00092, ss = 0.035,
                   sa = 0.01874, sb = 0.01043, ta = 0.02308, tb = 0.00916, u = 0.04, ua = 0.01228,
                   ub = 0.00449, zf = 0.02, zt = 0.04, fa = 0.01421;
  return {AndrewsLink{0.04325, 2.194e-6, {ra, 0.0}, {rr, 0.0}, beta},
          AndrewsLink{0.00365, 4.410e-7, {-da, 0.0}, {-d, 0.0}, beta + Theta},
          AndrewsLink{0.02373, 5.255e-6, {sb, -sa}, {0.0, -ss}, gamma},
          AndrewsLink{0.00706, 5.667e-7, {0.0, ea - e}, {0.0, -e}, phi + delta},
          AndrewsLink{0.07050, 1.169e-5, {ta, tb}, {zt, 0.0}, delta},
          AndrewsLink{0.00706, 5.667e-7, {zf - fa, 0.0}, {zf, 0.0}, Omega + epsilon},
          AndrewsLink{0.05498, 1.912e-5, {-ub, -ua}, {0.0, -u}, epsilon}};
}

AndrewsScene Andrews::scene() const {
  AndrewsScene built{.scene = Scene<2>("andrews"), .links = {}, .joints = {}, .pins_at_E = {}};
  std::array<Vec<2>, count> begin = fixed_points(*this);
  const auto turn = [this](std::size_t k) { return Eigen::Rotation2Dd(links[k].angle); };
  for (const std::size_t k : {1U, 3U, 5U}) {
    const auto before = static_cast<std::size_t>(parent[k]);
    begin[k] += turn(before) * links[before].joint;
  }
  for (std::size_t k = 0; k < count; ++k) {
    const AndrewsLink& link = links[k];
    built.links[k] = add_body(built.scene,
                              {.mass = link.mass,
                               .inertia = link.inertia,
                               .centre = begin[k] + turn(k) * link.centre,
                               .angle = link.angle},
                              numbered("K", k + 1));
    built.joints[k] = built.links[k].point(link.joint - link.centre);
  }
  const auto first_joint = [&](std::size_t k) { return built.links[k].point(-links[k].centre); };
  for (const std::size_t k : {0U, 2U, 4U, 6U})
    built.scene.add(Coincident{Fixed<2>{begin[k]}, first_joint(k)});
  for (const std::size_t k : {1U, 3U, 5U})
    built.scene.add(Coincident{built.joints[static_cast<std::size_t>(parent[k])], first_joint(k)});
  std::size_t pin = 0;
  for (const std::size_t k : {2U, 3U, 5U})
    built.pins_at_E[pin++] = built.scene.add(Coincident{built.joints[1], built.joints[k]});

  built.scene.add(Couple{Fixed<2>{}, built.joints[0], torque}, "drive");
  built.scene.add(Spring{Fixed<2>{C}, built.links[2].point(D - links[2].centre), stiffness, relaxed_length});
  return built;
}

std::vector<Observation<2>> Andrews::reference(std::span<const double> times) const {
  const auto equations = [this](const State& y, State& y_rate) {  // y = (theta, theta')
    const VecOf<Real, 13> solved = solve_motion(*this, y);
    for (std::size_t k = 0; k < count; ++k) {
      y_rate[k] = y[count + k];
      y_rate[count + k] = solved[static_cast<int>(k)];
    }
  };
  std::vector<Observation<2>> seen;
  integrate(equations, at_rest(*this), times, [&](const State& y) { seen.push_back(observation(*this, y)); });
  return seen;
}

Observation<2> Andrews::reference(double t) const { return reference(std::array{t}).front(); }

Model<2> Andrews::model() const {
  const auto far = motion(*this, 2, D, at_rest(*this));
  const double stretch = static_cast<double>((far.r - C.cast<Real>()).norm()) - relaxed_length;
  return {.name = "andrews",
          .notes = "-",
          .reference = "angles of the links and forces at E in extended precision",
          .t_end = 0.03,
          .length = links[6].joint.norm(),
          .force = std::abs(stiffness * stretch),
          .energy = 0.5 * stiffness * stretch * stretch,
          .scene =
              [*this] {
                AndrewsScene built = scene();
                const auto observe = [joints = built.joints,
                                      pins = built.pins_at_E](const Sample<2>& sample) {
                  Observation<2> seen;
                  for (const auto& joint : joints) seen.positions.push_back(sample.position(joint));
                  for (const auto& pin : pins) {
                    const Vec<2> force = sample.multiplier(pin);
                    seen.forces.insert(seen.forces.end(), {force.x(), force.y()});
                  }
                  return seen;
                };
                return Observed<2>{std::move(built.scene), observe, {}};  // the couple does work
              },
          .observations = [*this](std::span<const double> times) { return reference(times); }};
}

}  // namespace dalembert::models
