#include <dalembert/core/analysis/virtual_work.h>
#include <dalembert/models/catalogue.h>

#include <gtest/gtest.h>

#include <limits>

namespace dalembert::models::virtual_work_test {
namespace {

/// Round-off of a sum of a few hundred products, each of a force with a unit vector's component.
constexpr double round_off = 1000.0 * std::numeric_limits<double>::epsilon();

/// d'Alembert's principle (mln7): the forces of constraint do no work in any displacement that the
/// constraints allow at a fixed time; if no constraint depends on time, nor in the actual one.
template <int D>
void expect_no_virtual_work(const Model<D>& model) {
  SCOPED_TRACE(model.name);
  const Observed<D> observed = model.scene();
  const System system = observed.scene.system();
  const auto run = simulate(observed.scene, {.t_end = model.t_end, .samples = 11});
  for (std::size_t i = 0; i < run.size(); ++i) {
    const FlatSample sample = run.sample(i).flat();
    const VirtualWork at = virtual_work(system, sample);
    EXPECT_LE(at.largest, round_off * at.largest_force) << "sample " << i;
    if (system.rheonomic()) continue;
    double speed = 0.0;
    for (const double v : sample.v) speed += std::abs(v);
    for (const auto& constraint : at.constraints) {
      EXPECT_LE(std::abs(constraint.power), round_off * at.largest_force * speed)
          << constraint.name << ", sample " << i;
    }
  }
}

TEST(Catalogue, ObeysDAlembertsPrinciple) {
  for (const AnyModel& any : catalogue()) {
    std::visit([](const auto& model) { expect_no_virtual_work(model); }, any);
  }
}

}  // namespace
}  // namespace dalembert::models::virtual_work_test
