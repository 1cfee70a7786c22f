#include "dalembert/bench/peers/simbody_rods.h"

#include <dalembert/bench/processor_time.h>

#include <Simbody.h>

#include <cmath>

namespace dalembert::bench::simbody {

namespace {

/// Each bead is a body with its origin in the bead.
struct Hanging {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::GeneralForceSubsystem forces{system};
  std::vector<SimTK::MobilizedBody> beads;
};

SimTK::Body bead(const Rod& rod) {
  return SimTK::Body::Rigid(SimTK::MassProperties(rod.mass, SimTK::Vec3(0), SimTK::UnitInertia(0)));
}

/// At angle zero a pin's rod goes on in the direction of the one above, the first one's down.
void hang_by_pins(Hanging& built, const std::vector<Rod>& rods) {
  SimTK::MobilizedBody above = built.matter.Ground();
  double last = 0.0;
  for (const Rod& rod : rods) {
    const SimTK::Vec3 upper_end(0, rod.length, 0);
    SimTK::MobilizedBody::Pin pin(above, SimTK::Vec3(0), bead(rod), upper_end);
    pin.setDefaultAngle(rod.angle - last);
    last = rod.angle;
    built.beads.push_back(pin);
    above = pin;
  }
}

void hang_by_rods(Hanging& built, const std::vector<Rod>& rods) {
  SimTK::MobilizedBody above = built.matter.Ground();
  SimTK::Vec3 position(0);
  for (const Rod& rod : rods) {
    position += rod.length * SimTK::Vec3(std::sin(rod.angle), -std::cos(rod.angle), 0);
    SimTK::MobilizedBody::Translation free(built.matter.Ground(), SimTK::Vec3(0), bead(rod), SimTK::Vec3(0));
    free.setDefaultTranslation(position);
    SimTK::Constraint::Rod(above, free, rod.length);
    built.beads.push_back(free);
    above = free;
  }
}

/// Tensions by Newton's law from the last bead up, e_i the unit vector along the rod above bead i:
///
///   tension_i = m_i (g - a_i) . e_i + tension_(i+1) e_(i+1) . e_i
Sample observe(const Hanging& built, const std::vector<Rod>& rods, double gravity,
               const SimTK::State& state) {
  built.system.realize(state, SimTK::Stage::Acceleration);
  Sample seen{{}, std::vector<double>(rods.size())};
  for (const SimTK::MobilizedBody& body : built.beads) {
    const SimTK::Vec3 r = body.getBodyOriginLocation(state);
    seen.positions.push_back({r[0], r[1]});
  }
  SimTK::Vec3 pull(0);  // of the rod below
  for (std::size_t i = rods.size(); i-- > 0;) {
    const SimTK::Vec3 above = i == 0 ? SimTK::Vec3(0) : built.beads[i - 1].getBodyOriginLocation(state);
    const SimTK::UnitVec3 e(built.beads[i].getBodyOriginLocation(state) - above);
    const SimTK::Vec3 g(0, -gravity, 0);
    seen.tensions[i] =
        SimTK::dot(rods[i].mass * (g - built.beads[i].getBodyOriginAcceleration(state)) + pull, e);
    pull = seen.tensions[i] * e;
  }
  return seen;
}

}  // namespace

Run run(const std::vector<Rod>& rods, double gravity, Coordinates coordinates,
        const std::vector<double>& times, double tolerance) {
  Hanging built;
  SimTK::Force::UniformGravity(built.forces, built.matter, SimTK::Vec3(0, -gravity, 0));
  coordinates == Coordinates::minimal ? hang_by_pins(built, rods) : hang_by_rods(built, rods);
  SimTK::State state = built.system.realizeTopology();
  state.setTime(times.front());

  SimTK::RungeKuttaMersonIntegrator integrator(built.system);
  integrator.setAccuracy(tolerance);
  integrator.setFinalTime(times.back());
  integrator.setAllowInterpolation(false);  // which is less precise than its steps
  integrator.initialize(state);

  Run result{};
  const double begin = processor_time();
  for (const double t : times) {
    while (integrator.getTime() < t) integrator.stepTo(t);
    result.samples.push_back(observe(built, rods, gravity, integrator.getState()));
  }
  result.run_time = processor_time() - begin;
  result.steps = integrator.getNumStepsTaken();
  result.evaluations = integrator.getNumRealizations();
  return result;
}

}  // namespace dalembert::bench::simbody
