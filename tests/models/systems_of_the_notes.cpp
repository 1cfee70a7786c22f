#include <dalembert/models/catalogue.h>
#include <dalembert/models/cone.h>
#include <dalembert/models/disk_on_rotating_track.h>
#include <dalembert/models/driven_pivot.h>
#include <dalembert/models/elastic_string_circle.h>
#include <dalembert/models/error.h>
#include <dalembert/models/governor.h>
#include <dalembert/models/hoop_about_diameter.h>
#include <dalembert/models/hoop_about_external_axis.h>
#include <dalembert/models/sliding_pivot.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <string>

/// The library against the hand derivations, and what a run must conserve or account for.
namespace dalembert::models::systems_of_the_notes_test {
namespace {

constexpr double tolerance = 1e-8;

/// The bounds of the requirement (issue "Every system of the notes", 1), and what the system conserves,
/// energy or Jacobi integral, to `steps` multiples of the tolerance: each step may add its tolerance in
/// positions and speeds.
template <int D>
void expect_accurate(const Model<D>& model) {
  SCOPED_TRACE(model.name);
  const Measurement m = measure(model, {.t_end = model.t_end, .tolerance = tolerance});
  EXPECT_LE(m.error_position, 1e-5);
  EXPECT_LE(m.error_force, 1e-4);
  if (model.scene().conserved) {
    EXPECT_LE(m.energy_drift, static_cast<double>(m.statistics.steps) * tolerance);
  }
}

TEST(SystemsOfTheNotes, StandInTheCatalogueAndMeetItsAccuracy) {
  std::set<std::string> missing{"parabolic-slide",
                                "sliding-pivot",
                                "sliding-rod",
                                "disk-on-incline",
                                "elastic-string-line",
                                "elastic-string-circle",
                                "hoop-about-diameter",
                                "hoop-about-external-axis",
                                "governor",
                                "disk-on-rotating-track",
                                "driven-pivot-vertical",
                                "driven-pivot-horizontal",
                                "driven-pivot-circular"};
  for (const AnyModel& any : catalogue()) {
    std::visit(
        [&](const auto& model) {
          if (missing.erase(model.name) == 1) expect_accurate(model);
        },
        any);
  }
  EXPECT_TRUE(missing.empty()) << "without " << *missing.begin();
}

TEST(SystemsOfTheNotes, MeetItsAccuracyWithTheOtherParametersOfTheNotes) {
  expect_accurate(ElasticStringCircle{.tied = ElasticStringCircle::Tied::inside}.model());
  expect_accurate(HoopAboutDiameter{.spin = 2.0}.model());  // Omega^2 < g/R: about the bottom
  expect_accurate(DiskOnRotatingTrack{.inertia_ratio = 1.0}.model());
}

TEST(SystemsOfTheNotes, SlidingPivotKeepsItsMomentumAlongTheTrack) {
  const SlidingPivot pivot;
  const BlockAndBob built = pivot.scene();
  const Trajectory<2> run = simulate(built.scene, {.t_end = 10.0, .tolerance = tolerance});
  const double bound = static_cast<double>(run.statistics().steps) * tolerance;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double momentum =
        pivot.block_mass * run.velocity(built.block, i).x() + pivot.bob_mass * run.velocity(built.bob, i).x();
    EXPECT_NEAR(momentum, 0.0, bound);
  }
}

TEST(SystemsOfTheNotes, ConeKeepsTheAngularMomentumAboutItsAxis) {
  const ConeSlide cone;
  const ParticleOnCone built = cone.scene();
  const Trajectory<3> run = simulate(built.scene, {.t_end = 10.0, .tolerance = tolerance});
  const auto about_axis = [&](std::size_t i) {
    return run.position(built.particle, i).cross(run.velocity(built.particle, i)).z();
  };
  for (std::size_t i = 0; i < run.size(); ++i)
    EXPECT_NEAR(about_axis(i), about_axis(0), static_cast<double>(run.statistics().steps) * tolerance);
}

/// Checks that the change of energy is the power integrated by Simpson's rule. A rule of order 4 on steps
/// twice as long errs 16 times as much, so that the two differ by 15 times the error of the finer: a bound
/// with a digit to spare. To it comes what steps of the tolerance add to the energy and, over the time, to
/// the power.
template <int D>
void expect_work_is_change_of_energy(const Scene<D>& scene, double t_end, double energy_scale,
                                     const std::function<double(const Sample<D>&)>& power) {
  constexpr int intervals = 4000;
  const Trajectory<D> run =
      simulate(scene, {.t_end = t_end, .samples = intervals + 1, .tolerance = tolerance});
  const auto simpson = [&](std::size_t stride) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 2 * stride < run.size(); i += 2 * stride) {
      sum += power(run.sample(i)) + 4 * power(run.sample(i + stride)) + power(run.sample(i + 2 * stride));
    }
    return sum * static_cast<double>(stride) * t_end / intervals / 3;
  };
  const double work = simpson(1), quadrature = std::abs(work - simpson(2));
  const double integration = static_cast<double>(run.statistics().steps) * tolerance * energy_scale;
  EXPECT_NEAR(run.energy(run.size() - 1) - run.energy(0), work, quadrature + integration);
  EXPECT_LT(quadrature, integration);
  double largest = 0.0;
  for (std::size_t i = 0; i < run.size(); ++i)
    largest = std::max(largest, std::abs(run.energy(i) - run.energy(0)));
  EXPECT_GT(largest, 0.01 * energy_scale);  // there is something to account for
}

double cross(const Vec<2>& a, const Vec<2>& b) { return a.x() * b.y() - a.y() * b.x(); }

// What turns at Omega about an axis delivers Omega times the torque of its forces about it.

TEST(PowerOfTheDrive, IsWhatChangesTheEnergyOfTheHoopAboutAnExternalAxis) {
  const HoopAboutExternalAxis hoop;
  const BeadOnCurve built = hoop.scene();
  expect_work_is_change_of_energy<2>(built.scene, 5.0, hoop.model().energy, [&](const Sample<2>& sample) {
    return hoop.spin * cross(sample.position(built.bead), sample.constraint_force(built.bead));
  });
}

TEST(PowerOfTheDrive, IsWhatChangesTheEnergyOfTheHoopAboutItsDiameter) {
  const HoopAboutDiameter hoop;
  const BeadOnHoop built = hoop.scene();
  expect_work_is_change_of_energy<3>(built.scene, 5.0, hoop.model().energy, [&](const Sample<3>& sample) {
    return hoop.spin * sample.position(built.bead).cross(sample.constraint_force(built.bead)).z();
  });
}

TEST(PowerOfTheDrive, IsWhatChangesTheEnergyOfTheGovernor) {
  const Governor governor;
  const auto [scene, parts] = governor.scene();
  expect_work_is_change_of_energy<3>(
      scene, 5.0, governor.model().energy, [&masses = parts.masses, &governor](const Sample<3>& sample) {
        double torque = 0.0;
        for (const Particle<3>& mass : masses)
          torque += sample.position(mass).cross(sample.constraint_force(mass)).z();
        return governor.spin * torque;
      });
}

TEST(PowerOfTheDrive, IsWhatChangesTheEnergyOfTheRotatingTrack) {
  // The torque on a disk about the origin: of the force at its centre, and about its centre. By the notes it
  // all comes from the normal force: N q.
  const DiskOnRotatingTrack disk;
  const DiskOnTrack built = disk.scene();
  expect_work_is_change_of_energy<2>(built.scene, 3.0, disk.model().energy, [&](const Sample<2>& sample) {
    const double about_centre = sample.constraint_torque(built.grip, built.wheel);
    return disk.spin *
           (cross(sample.position(built.centre), sample.constraint_force(built.centre)) + about_centre);
  });
}

TEST(PowerOfTheDrive, EqualsTheForceOnADrivenPivotTimesItsVelocity) {
  for (const DrivenPivot& pivot :
       {DrivenPivot::horizontal(), DrivenPivot::vertical(), DrivenPivot::circular()}) {
    SCOPED_TRACE(pivot.model().name);
    const DrivenPendulum built = pivot.scene();
    expect_work_is_change_of_energy<2>(built.scene, 5.0, pivot.model().energy, [&](const Sample<2>& sample) {
      const double phase = pivot.frequency * sample.time();
      const Vec<2> velocity = -pivot.frequency * Vec<2>(pivot.amplitude_x * std::sin(phase),
                                                        pivot.amplitude_y * std::sin(phase + pivot.phase));
      return sample.constraint_force(built.bob).dot(velocity);  // the rod hands on what the pivot gives
    });
  }
}

}  // namespace
}  // namespace dalembert::models::systems_of_the_notes_test
