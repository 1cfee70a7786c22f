#include <dalembert/dalembert.h>
#include <dalembert/tests/both_steppers.h>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

/// Random scenes with Coulomb's friction: it never adds energy, and never exceeds its bound.
namespace dalembert::rough_scenes_test {
namespace {

template <int D>
Vec<D> random() {
  return Eigen::Vector<double, D>::Random();
}

constexpr double g = 9.81, tolerance = 1e-6;
#ifdef NDEBUG
constexpr int scenes = 1000;
#else
constexpr int scenes = 100;  // under sanitizers a thousand take minutes
#endif

class RoughScenes : public testing::TestWithParam<Stepper> {
 protected:
  [[nodiscard]] double between(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(generator_);
  }
  [[nodiscard]] bool one_in(int n) { return std::uniform_int_distribution<int>(1, n)(generator_) == 1; }

  /// A particle that a surface holds, rough, with gravity and perhaps a spring.
  template <int D, class Surface>
  void run(const Surface& surface, const Vec<D>& place) {
    Scene<D> scene("rough");
    scene.add(UniformGravity<D>{-g * Vec<D>::Unit(D - 1)});
    const Vec<D> n = surface.normal_at(place);
    Vec<D> v = one_in(4) ? Vec<D>(Vec<D>::Zero()) : Vec<D>(between(0.1, 3.0) * random<D>());
    v -= n * n.dot(v);
    const double mass = between(0.1, 3.0);
    const auto particle = scene.add_particle({.mass = mass, .position = place, .velocity = v});
    const auto holds = scene.add(held_by(particle, surface));
    const double mu = between(0.0, 0.9), mu_static = mu + (one_in(2) ? 0.0 : between(0.0, 0.4));
    const auto rough = scene.add(coulomb(holds, Slip{particle, surface}, mu, mu_static));
    if (one_in(2)) scene.add(Spring{Fixed<D>{random<D>()}, particle, between(1.0, 50.0), between(0.0, 1.0)});
    const auto run =
        simulate(scene, {.t_end = 0.7, .samples = 15, .tolerance = tolerance, .stepper = GetParam()});
    const auto& s = run.statistics();
    const double unit = mass * std::pow(s.length / s.time, 2) + mass * g * s.length;
    double before = run.energy(0);
    for (std::size_t i = 0; i < run.size(); ++i) {
      // A run errs by some tens of its tolerance.
      EXPECT_LE(run.energy(i), before + 100.0 * tolerance * unit) << run_ << ", sample " << i;
      before = run.energy(i);
      const double sigma = size(run.multiplier(rough, i)), pressing = std::abs(run.multiplier(holds, i));
      EXPECT_LE(sigma, mu_static * pressing + 100.0 * tolerance * (unit / s.length))
          << run_ << ", sample " << i;
    }
  }

  std::mt19937 generator_{7};
  int run_ = 0;

 private:
  template <int D, class Surface>
  [[nodiscard]] static auto held_by(Particle<D> particle, const Surface& surface) {
    if constexpr (D == 2) {
      return OnCurve{particle, surface};
    } else {
      return OnSurface{particle, surface};
    }
  }
  [[nodiscard]] static double size(double sigma) { return std::abs(sigma); }
  [[nodiscard]] static double size(const Vec<2>& sigma) { return sigma.norm(); }
};
INSTANTIATE_TEST_SUITE_P(Steppers, RoughScenes, both_steppers, stepper_name);

TEST_P(RoughScenes, NeverGainEnergy) {
  std::srand(1);
  for (run_ = 0; run_ < scenes; ++run_) {
    switch (run_ % 4) {
      case 0:
        run<2>(Plane<2>{Vec<2>::Zero(), Vec<2>(between(-1.0, 1.0), 1.0)}, Vec<2>::Zero());
        break;
      case 1: {
        const double angle = between(0.0, 6.28);
        run<2>(Sphere<2>{.radius = 1.0}, Vec<2>(std::cos(angle), std::sin(angle)));
        break;
      }
      case 2:
        run<3>(Plane<3>{Vec<3>::Zero(), Vec<3>(between(-1.0, 1.0), between(-1.0, 1.0), 1.0)}, Vec<3>::Zero());
        break;
      default:
        run<3>(Sphere<3>{.radius = 1.0}, random<3>().normalized());
    }
  }
}

}  // namespace
}  // namespace dalembert::rough_scenes_test
