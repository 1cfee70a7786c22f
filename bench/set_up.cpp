#include <dalembert/bench/commands.h>
#include <dalembert/bench/median.h>
#include <dalembert/bench/processor_time.h>
#include <dalembert/bench/progress.h>
#include <dalembert/dalembert.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace dalembert::bench {

namespace {

void add_pendulums(Scene<2>& scene, int count) {
  for (int i = 0; i < count; ++i) {
    const auto bob = scene.add_particle({.mass = 1.0, .position = {2.0 * i + 1.0, 0.0}});
    scene.add(Distance{Fixed<2>{{2.0 * i, 0.0}}, bob, 1.0});
  }
}

/// Blocks on a floor, or above it; those on it may slide.
struct Blocks {
  double height, speed;
  bool rough;
  double pull = 0.0;  // along the floor, an acceleration

  void operator()(Scene<2>& scene, int count) const {
    scene.add(UniformGravity<2>{{pull, 0.0}});
    for (int i = 0; i < count; ++i) {
      const auto block =
          scene.add_particle({.mass = 1.0, .position = {2.0 * i, height}, .velocity = {speed, 0.0}});
      const auto floor = scene.add(unilateral(OnCurve{block, Plane<2>{}}, {.restitution = 0.5}));
      if (rough) scene.add(coulomb(floor, Slip{block, Plane<2>{}, {0.0, 0.0}}, 0.3));
    }
  }
};

struct Kind {
  const char* name;
  std::function<void(Scene<2>& scene, int count)> add;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{{"pendulums", add_pendulums},
                                     {"contacts, open", Blocks{1.0, 0.0, false}},
                                     {"contacts, closed", Blocks{0.0, 0.0, false}},
                                     {"friction, sticks", Blocks{0.0, 0.0, true}},
                                     {"friction, begins to slide", Blocks{0.0, 0.0, true, 5.0}},
                                     {"friction, slides", Blocks{0.0, 1.0, true}}};
  return all;
}

/// States a scene, begins its run and takes the first steps, a millisecond.
double time_to_begin(const Kind& kind, int count, Stepper stepper) {
  const double before = processor_time();
  Scene<2> scene(kind.name);
  scene.add(UniformGravity<2>{{0.0, -9.81}});
  kind.add(scene, count);
  const auto run = simulate(scene, {.t_end = 1e-3, .samples = 2, .stepper = stepper});
  return processor_time() - before;
}

}  // namespace

void set_up(const SetUpOptions& options) {
  require_writable(options.report);
  Table table{.columns = {"scene", "stepper", "size", "time_s", "time_each_s", "outcome"}, .rows = {}};
  Progress progress(kinds().size() * options.steppers.size() * options.sizes.size());
  for (const Kind& kind : kinds()) {
    for (const Stepper stepper : options.steppers) {
      for (const int size : options.sizes) {
        const std::string what = std::string(kind.name) + ", " + name(stepper) + ", " + std::to_string(size);
        progress.next(what);
        double time = std::numeric_limits<double>::quiet_NaN();
        const Outcome outcome = attempt(what, [&] {
          std::vector<double> times;
          for (int i = 0; i < options.repeats; ++i) times.push_back(time_to_begin(kind, size, stepper));
          time = median(times);
        });
        table.rows.push_back({kind.name, name(stepper), std::to_string(size), scientific(time, 3),
                              scientific(time / size, 3), outcome.name});
      }
    }
  }
  report("What a scene costs at its start: stated, begun and run for a millisecond, the median of several",
         table, options.report);
}

}  // namespace dalembert::bench
