#include "plan.h"

#include <algorithm>
#include <array>
#include <limits>

namespace dalembert::fuzz {

namespace {

/// Enough for the scenes here, and few enough that none takes seconds.
constexpr long most_steps = 3000;

Options random_options(Random& random, const Plan& plan) {
  Options o;
  const double sign = random.sign();
  o.t_start = random.chance(0.7) ? 0.0 : sign * plan.time * random.decades(-2.0, 4.0);
  o.t_end = o.t_start + plan.time * random.decades(-1.0, 0.5);
  o.tolerance = random.decades(-9.0, -3.0);
  o.samples = 2 + random.below(20);
  if (random.chance(0.2)) o.sample_interval = (o.t_end - o.t_start) / random.between(1.0, 20.0);
  if (o.sample_interval == 0.0 && random.chance(0.2)) {
    for (double share = random.uniform(); share < 1.0; share += random.uniform() + 1e-3)
      o.times.push_back(o.t_start + share * (o.t_end - o.t_start));
  }
  o.max_steps = random.chance(0.05) ? 1 + random.below(20) : most_steps;
  o.assemble = !plan.moving && random.chance(0.5) ? false : random.chance(0.95);
  return o;
}

void spoil(Random& random, Options& o) {
  switch (random.below(10)) {
    case 0:
      o.t_end = o.t_start - random.uniform();
      break;
    case 1:
      o.t_end = wrong_number(random, o.t_end);
      break;
    case 2:
      o.t_start = wrong_number(random, o.t_start);
      break;
    case 3:
      o.tolerance = 0.0;
      break;
    case 4:
      o.tolerance = wrong_number(random, o.tolerance);
      break;
    case 5:
      o.samples = random.below(4) - 2;
      break;
    case 6:
      o.sample_interval = wrong_number(random, o.t_end - o.t_start);
      break;
    case 7:
      o.times = {o.t_start, wrong_number(random, o.t_end)};
      break;
    case 8:
      o.max_steps = random.below(3) - 1;
      break;
    default:
      o.times = {o.t_end, o.t_start};
  }
}

/// What is run twice is run as far as an error made at the start stays an error of its own order, and the two
/// start alike.
void make_comparable(Random& random, Plan& plan) {
  Options& o = plan.options;
  o.t_end = std::min(o.t_end, o.t_start + 2.0 * plan.time);
  std::erase_if(o.times, [&](double t) { return t > o.t_end; });
  o.sample_interval = std::min(o.sample_interval, o.t_end - o.t_start);
  o.max_steps = 10 * most_steps;
  o.assemble = true;
  plan.particles = std::min(plan.particles, 2);
  plan.bodies = std::min(plan.bodies, 1);
  plan.constraints = std::min(plan.constraints, 2);
  if (plan.family == Family::redundant) {
    plan.turns = random.chance(0.3) ? 10.0 : 1.0;
    plan.repeat = 0.5;
  }
}

/// Particles on rods and springs. A tenth of them among what moves.
void make_one_sided(Random& random, Plan& plan) {
  Options& o = plan.options;
  o.max_steps = 3 * most_steps;
  o.assemble = true;
  plan.bodies = plan.rotors = 0;
  plan.particles = 1 + random.below(5);
  plan.constraints = random.below(plan.particles);
  const bool rough = plan.family == Family::rough;  // where it moves it works
  plan.still = !rough && random.chance(0.1) ? 0.6 : 1.0;
  plan.lossless = !rough && random.chance(0.3);
}

/// Two to four features. Tolerances from loose to tight, over as long as errors stay of their own order.
void make_product(Random& random, Plan& plan) {
  Options& o = plan.options;
  for (int n = 2 + random.below(3); n > 0; --n) {
    const Feature feature = features[static_cast<std::size_t>(random.below(drawn_features))];
    if (!plan.has(feature)) plan.features.push_back(feature);
  }
  o.t_start = random.chance(0.7) ? 0.0 : plan.time * random.between(-10.0, 10.0);
  o.t_end = o.t_start + plan.time * random.decades(-0.5, 0.3);
  o.tolerance = random.decades(-12.0, -4.0);
  o.samples = 11;
  o.sample_interval = 0.0;
  o.times.clear();
  o.max_steps = 10 * most_steps;
  o.assemble = true;
  o.dense = plan.has(Feature::dense);
  plan.spread = 0.3;
  plan.particles = 1 + random.below(3);
  plan.bodies = plan.rotors = 0;
  plan.still = plan.has(Feature::driven) ? 0.2 : 1.0;
}

/// The features that follow from options.
void add_options(Plan& plan) {
  plan.features.push_back(plan.options.stepper == Stepper::ida ? Feature::ida : Feature::erk);
  if (plan.options.tolerance > 1e-6) plan.features.push_back(Feature::loose);
  if (plan.options.tolerance < 1e-9) plan.features.push_back(Feature::tight);
}

}  // namespace

bool Plan::has(Feature feature) const { return std::ranges::find(features, feature) != features.end(); }

const char* name(Plan::Kind kind) {
  return kind == Plan::Kind::sensible ? "sensible" : kind == Plan::Kind::wild ? "wild" : "invalid";
}

double wrong_number(Random& random, double meant) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::array<double, 11> wrong{std::numeric_limits<double>::quiet_NaN(),
                                     infinity,
                                     -infinity,
                                     0.0,
                                     -meant,
                                     1e300,
                                     -1e300,
                                     1e-300,
                                     std::numeric_limits<double>::denorm_min(),
                                     meant * 1e12,
                                     meant * 1e-12};
  return wrong[static_cast<std::size_t>(random.below(static_cast<int>(wrong.size())))];
}

const char* name(Family family) {
  switch (family) {
    case Family::any:
      return "any";
    case Family::redundant:
      return "redundant";
    case Family::kinked:
      return "kinked";
    case Family::one_sided:
      return "one-sided";
    case Family::rough:
      return "rough";
    default:
      return "products";
  }
}

Plan random_plan(Random& random, Family family, Stepper stepper) {
  Plan plan;
  plan.family = family;
  const double kind = random.uniform();
  plan.kind = kind < 0.6 ? Plan::Kind::sensible : kind < 0.8 ? Plan::Kind::wild : Plan::Kind::invalid;
  if (family != Family::any) plan.kind = Plan::Kind::sensible;
  if (random.chance(0.5)) {
    plan.length = random.decades(-9.0, 9.0);
    plan.time = random.decades(-9.0, 9.0);
    plan.mass = random.decades(-9.0, 9.0);
  }
  if (plan.kind == Plan::Kind::wild) plan.spread = random.between(1.0, 6.0);
  if (plan.kind == Plan::Kind::invalid) plan.wrong = random.decades(-2.0, -0.5);
  plan.particles = random.below(6);
  plan.bodies = random.chance(0.4) ? 1 + random.below(2) : 0;
  plan.rotors = random.chance(0.4) ? 1 + random.below(2) : 0;
  if (plan.particles + plan.bodies + plan.rotors == 0) plan.particles = 1;
  plan.constraints = random.below(3 + plan.particles + 2 * plan.bodies);
  plan.forces = random.below(7);
  plan.moving = random.chance(0.7);
  plan.options = random_options(random, plan);
  if (plan.kind == Plan::Kind::invalid && random.chance(0.2)) spoil(random, plan.options);
  if (family == Family::one_sided || family == Family::rough) {
    make_one_sided(random, plan);
  } else if (family == Family::products) {
    make_product(random, plan);
  } else if (family != Family::any) {
    make_comparable(random, plan);
  }
  plan.options.stepper = stepper;
  if (family == Family::products) add_options(plan);
  return plan;
}

}  // namespace dalembert::fuzz
