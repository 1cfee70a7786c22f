// Mistakes, of which each must be answered by its sentence within the first ten lines; none by default.
#include <dalembert/dalembert.h>
#include <dalembert/eigen.h>

using namespace dalembert;

struct TwoLaws {
  Particle<2> p;
  Constraint<1> rod;
  auto points() const { return std::tuple{p}; }
  const Constraint<1>& constraint() const { return rod; }
  auto force(const auto&, const auto& v) const { return (-v).eval(); }
  auto friction(const auto& lambda, const auto&, const auto& v) const { return (-lambda * v).eval(); }
};

struct EnergyAndForce {
  Particle<2> p;
  auto points() const { return std::tuple{p}; }
  auto energy(const auto& r) const { return 0.5 * r.dot(r); }
  auto force(const auto&, const auto& v) const { return (-v).eval(); }
};

[[maybe_unused]] const auto make = [](Scene<2>& scene) {
  const auto bead = scene.add_particle({.mass = 1.0, .position = {1.0, 0.0}}, "bead");
  [[maybe_unused]] const auto rod = scene.add(Distance{Fixed<2>{}, bead, 1.0});
#ifdef MISTAKE_dynamic_size  // a constraint's equation returns a number or a plain column
  scene.add(holonomic(points(bead), [](auto r) { return Eigen::VectorX<typename decltype(r)::Scalar>(r); }));
#endif
#ifdef MISTAKE_row  // a constraint's equation returns a number or a plain column
  scene.add(nonholonomic(points(bead), [](auto, auto v) { return v.transpose().eval(); }));
#endif
#ifdef MISTAKE_matrix  // a constraint's equation returns a number or a plain column
  scene.add(holonomic(points(bead), [](auto r) { return (r * r.transpose()).eval(); }));
#endif
#ifdef MISTAKE_curve_of_dynamic_size  // a constraint's equation returns a number or a plain column
  scene.add(OnCurve{bead, [](auto r) { return Eigen::VectorX<typename decltype(r)::Scalar>(r); }});
#endif
#ifdef MISTAKE_compliant_contact  // a compliant constraint is two-sided, and compliant once
  scene.add(compliant(unilateral(Distance{Fixed<2>{}, bead, 1.0}), 0.1));
#endif
#ifdef MISTAKE_compliant_twice  // a compliant constraint is two-sided, and compliant once
  scene.add(compliant(compliant(Distance{Fixed<2>{}, bead, 1.0}, 0.1), 0.1));
#endif
#ifdef MISTAKE_dimensions  // all points of a constraint or force must have the dimension of the scene
  scene.add(Distance{Fixed<3>{}, bead, 1.0});
#endif
#ifdef MISTAKE_dimensions_of_lambda  // all points of a constraint or force must have the same dimension
  scene.add(holonomic(points(Fixed<3>{}, bead), [](auto a, auto b) { return (a - b).norm() - 1.0; }));
#endif
#ifdef MISTAKE_an_argument_less  // the lambda of a holonomic constraint takes the position
  scene.add(holonomic(points(bead, bead), [](auto a) { return a.norm() - 1.0; }));
#endif
#ifdef MISTAKE_an_argument_more  // gets time in front of them
  scene.add(holonomic(points(bead), [](auto a, auto b) { return (a - b).norm() - 1.0; }));
#endif
#ifdef MISTAKE_arguments_of_law  // the lambda of a force law takes the position of each of its points
  scene.add(force_law(points(bead), [](auto v) { return (-0.1 * v).eval(); }));
#endif
#ifdef MISTAKE_named_arguments  // write `auto` for the lambda's arguments
  scene.add(holonomic(points(bead), [](Vec<2> r) { return r.norm() - 1.0; }));
#endif
#ifdef MISTAKE_named_time  // write `auto` for the time that a path takes
  scene.add(Distance{driven([](double t) { return vec(t, 0.0); }), bead, 1.0});
#endif
#ifdef MISTAKE_force  // a force law returns one column of its point's dimension
  scene.add(force_law(points(bead), [](auto, auto v) { return vec(v.x(), v.y(), 0.0); }));
#endif
#ifdef MISTAKE_two_laws  // a force states one of energy(r), force(r, v) and friction(lambda, r, v)
  scene.add(TwoLaws{bead, rod});
#endif
#ifdef MISTAKE_energy_and_force  // a force states one of energy(r), force(r, v) and friction(lambda, r, v)
  scene.add(EnergyAndForce{bead});
#endif
#ifdef MISTAKE_energy  // a potential returns its energy, one number
  scene.add(potential(points(bead), [](auto r) { return r; }));
#endif
#ifdef MISTAKE_sine_of_std  // call sin(...) without std::
  scene.add(holonomic(points(bead), [](auto r) { return r.y() - std::sin(r.x()); }));
#endif
#ifdef MISTAKE_root_of_std  // call sqrt(...) without std::
  scene.add(OnCurve{bead, [](auto r) { return std::sqrt(r.dot(r)) - 1.0; }});
#endif
#ifdef MISTAKE_max_of_std  // call max(...) without std::
  scene.add(potential(points(bead), [](auto r) { return std::max(r.x(), 0.0); }));
#endif
#ifdef MISTAKE_joint_of_a_thin_rod  // a joint holds bodies of add_body
  const auto arm = add_thin_rod(scene, ThinRodState<2>{.mass = 1.0, .end = {1.0, 0.0}}, "arm");
  scene.add(Revolute{Ground<2>{}, arm, {0.0, 0.0}});
#endif
#ifdef MISTAKE_slip_on_a_moving_surface  // Slip takes a surface with normal_at(r)
  const Translating moving{Plane<2>{}, [](auto t) { return vec(0.0, sin(t)); }};
  scene.add(coulomb(scene.add(OnCurve{bead, moving}), Slip{bead, moving}, 0.3));
#endif
#ifdef MISTAKE_condition  // an event's function returns a number that crosses 0
  [[maybe_unused]] const Event<2> over{"over", [=](const auto& now) { return now.position(bead).x() > 1.0; }};
#endif
#ifdef MISTAKE_option  // is an option misspelled, or not in the order of solvers/base/options.h?
  const auto run = simulate(scene, {.t_end = 1.0, .tolerence = 1e-8});
#endif
};
