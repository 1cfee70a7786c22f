// Writes pages of systems: those of the browser's test, and others to look at.
//
//   dalembert-pages <folder> [name ...]      (all of them without a name)
#include <dalembert/dalembert.h>
#include <dalembert/models/chain.h>
#include <dalembert/models/cone.h>
#include <dalembert/models/four_bar.h>
#include <dalembert/models/governor.h>
#include <dalembert/models/rocking_block.h>
#include <dalembert/models/rolling_disk.h>
#include <dalembert/view/write_html.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace dalembert;

const PageOptions in_si{.units = {"m", "s", "N"}};

/// A pendulum from rest in horizontal position, as tests/page/page.mjs derives it again.
void pendulum(const std::filesystem::path& file, int samples) {
  Scene<2> scene("pendulum");
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  const auto bob = scene.add_particle({.mass = 2.0, .position = {1.5, 0.0}}, "bob");
  scene.add(Distance{Fixed<2>{}, bob, 1.5}, "rod");
  const Event<2> lowest{"lowest", [=](const auto& now) { return now.position(bob).x(); }};
  write_html(certify(scene, {.t_end = 10.0, .samples = samples, .tolerance = 1e-9, .ledger = true}, {lowest}),
             file, in_si);
}

/// Two hinges in one line: only the sum of their forces along it is unique. And names that HTML must not
/// read.
void door(const std::filesystem::path& file) {
  Scene<3> scene("</script><b>door & \"hinges\"");
  scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
  const auto door = add_body(scene,
                             BodyState<3>{.mass = 20.0,
                                          .inertia = {6.7, 7.8, 1.2},
                                          .centre = {0.4, 0.0, 1.0},
                                          .velocity = {0.0, 0.4, 0.0},
                                          .angular_velocity = {0.0, 0.0, 1.0}},
                             "<i>leaf</i>");
  scene.add(Revolute{Ground<3>{}, door, {0.0, 0.0, 0.3}, {0.0, 0.0, 1.0}}, "lower <hinge>");
  scene.add(Revolute{Ground<3>{}, door, {0.0, 0.0, 1.7}, {0.0, 0.0, 1.0}}, "upper hinge");
  write_html(simulate(scene, {.t_end = 6.0, .samples = 301}), file, in_si);
}

/// The front wheel of a car: two arms hinged to the chassis along skew axes, ball joints, tie rod and spring.
void double_wishbone(const std::filesystem::path& file) {
  const Vec<3> P1(0, 0.35, 0.2), d1(1, 0.05, 0.02), L(0.02, 0.8, 0.18), P2(-0.03, 0.4, 0.5),
      d2(1, -0.08, 0.06), U(-0.02, 0.74, 0.52), S(-0.15, 0.78, 0.25), T(-0.14, 0.38, 0.24), top(0, 0.55, 0.7),
      hub(0, 0.82, 0.35);
  const Vec<3> D = P1 + 0.6 * (L - P1) + Vec<3>(0, 0, 0.02);
  Scene<3> scene("double wishbone");
  scene.add(UniformGravity<3>{{0.0, 0.0, -9.81}});
  const auto lower = add_body(
      scene, BodyState<3>{.mass = 6.0, .inertia = {0.05, 0.02, 0.06}, .centre = (P1 + L) / 2}, "lower arm");
  const auto upper = add_body(
      scene, BodyState<3>{.mass = 4.0, .inertia = {0.03, 0.015, 0.04}, .centre = (P2 + U) / 2}, "upper arm");
  const auto upright =
      add_body(scene, BodyState<3>{.mass = 25.0, .inertia = {0.6, 0.9, 0.7}, .centre = hub}, "upright");
  const auto hinge = add_joint(scene, Revolute{Ground<3>{}, lower, P1, d1}, "lower hinge");
  scene.add(Revolute{Ground<3>{}, upper, P2, d2}, "upper hinge");
  scene.add(Coincident{lower.point_at(L), upright.point_at(L)}, "lower ball");
  scene.add(Coincident{upper.point_at(U), upright.point_at(U)}, "upper ball");
  scene.add(Distance{Fixed<3>{T}, upright.point_at(S), (S - T).norm()}, "tie rod");
  scene.add(Spring{Fixed<3>{top}, lower.point_at(D), 3e4, 0.5}, "spring");
  scene.add(AngleDrive{hinge, scene.add_rotor({.inertia = 0.01}, "armature"),
                       [](const auto& t) {
                         using std::sin;
                         return 0.2 * sin(2.0 * t) + 0.05 * sin(5.0 * t);
                       }},
            "motor");
  write_html(certify(scene, {.t_end = 6.3, .samples = 631, .tolerance = 1e-8, .assemble = true}), file,
             in_si);
}

void rocking_block(const std::filesystem::path& file) {
  const models::RockingBlock block;
  write_html(certify(block.scene().scene, {.t_end = 1.05 * block.rest_time(),
                                           .samples = 401,
                                           .tolerance = 1e-8,
                                           .stepper = Stepper::erk,
                                           .ledger = true}),
             file, in_si);
}

template <int D>
void model(const models::Model<D>& its, const std::filesystem::path& file) {
  const Options options{.t_end = its.t_end, .samples = 501, .tolerance = 1e-8, .ledger = true};
  write_html(certify(its.scene().scene, options), file, in_si);
}

using Write = std::function<void(const std::filesystem::path& file)>;
struct Page {
  std::string name;
  Write write;
};
const std::vector<Page> pages{
    {"pendulum", [](const auto& file) { pendulum(file, 1001); }},
    {"cone", [](const auto& file) { model(models::ConeSlide{}.model(), file); }},
    {"governor", [](const auto& file) { model(models::Governor{}.model(), file); }},
    {"rolling-disk", [](const auto& file) { model(models::RollingDisk{}.model(), file); }},
    {"chain", [](const auto& file) { model(models::Chain{}.model(), file); }},
    {"four-bar", [](const auto& file) { model(models::FourBar{}.model(), file); }},
    {"rocking-block", rocking_block},
    {"double-wishbone", double_wishbone},
    {"door", door},
    {"long-pendulum", [](const auto& file) { pendulum(file, 100'000); }},
};

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) throw Error("usage: dalembert-pages <folder> [name ...]");
  const std::vector<std::string> wanted(argv + 2, argv + argc);
  std::filesystem::create_directories(argv[1]);
  for (const Page& page : pages)
    if (wanted.empty() || std::ranges::find(wanted, page.name) != wanted.end())
      page.write(std::filesystem::path(argv[1]) / (page.name + ".html"));
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
