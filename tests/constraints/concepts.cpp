// What each type of point, force and constraint of the library is. Asserted here and not in the headers,
// where every user would pay for it.
#include <dalembert/dalembert.h>

namespace dalembert {

static_assert(Point<Fixed<2>> && Point<Particle<3>> && Point<Rotor>);
static_assert(Point<BodyPoint<2>> && Point<BodyPoint<3>> && Point<BodyPoint<3, 2>>);

// What lacks, or contradicts, one thing that is asked of a point.
template <int Dimension, int Inputs, int Coordinates, bool IsDriven>
struct Sizes {
  static constexpr int dimension = Dimension, inputs = Inputs, coordinates = Coordinates;
  static constexpr bool driven = IsDriven;
};
struct WithoutPlace : Sizes<2, 0, 0, false> {};
struct WithPlaceInSpace : Sizes<2, 0, 0, false> {
  Vec<3> position;
};
struct WithoutPath : Sizes<2, 0, 0, true> {
  Vec<2> position;
};
template <int Inputs, int Coordinates>
struct OfOneParticle : Sizes<2, Inputs, Coordinates, false> {
  std::array<Particle<2>, 1> particles;
  [[nodiscard]] std::array<int, static_cast<std::size_t>(Coordinates)> reads() const;
  [[nodiscard]] Vec<Inputs> gather(std::span<const double> q) const;
};
static_assert(Point<OfOneParticle<2, 2>>);
static_assert(!Point<OfOneParticle<1, 2>> && !Point<OfOneParticle<2, 4>>);
static_assert(!Point<WithoutPlace> && !Point<WithPlaceInSpace> && !Point<WithoutPath> && !Point<double>);

static_assert(PotentialForce<Spring<Fixed<2>, Particle<2>>>);
static_assert(LawForce<Damper<Particle<3>, Particle<3>>>);
static_assert(PotentialForce<Torque> && LawForce<QuadraticDrag<Particle<3>>>);
static_assert(LawForce<Couple<Fixed<2>, Particle<2>>>);
static_assert(PotentialForce<ElasticString<Fixed<2>, Particle<2>>>);

static_assert(HolonomicConstraint<Coincident<Particle<3>, Fixed<3>>>);
static_assert(rows_of_constraint<Coincident<Particle<2>, Particle<2>>> == 2);
static_assert(HolonomicConstraint<Distance<Particle<3>, Fixed<3>>>);
static_assert(HolonomicConstraint<DiskContact<Particle<3>, Particle<3>, Particle<3>>>);
static_assert(HolonomicConstraint<PointLineDistance<Particle<2>, Fixed<2>, Fixed<2>>>);
static_assert(HolonomicConstraint<OnCurve<Particle<2>, Sphere<2>>>);
static_assert(HolonomicConstraint<OnSurface<Particle<3>, Cone>>);
static_assert(HolonomicConstraint<OnSurface<Particle<3>, Plane<3>>>);

using Hinge = Revolute<Ground<3>, RigidBody<3>>;
static_assert(rows_of_constraint<Hinge> == 5 && rows_of_constraint<Revolute<Ground<2>, RigidBody<2>>> == 2);
static_assert(rows_of_constraint<Weld<RigidBody<3>, RigidBody<3>>> == 6);
static_assert(rows_of_constraint<Prismatic<RigidBody<3>, Ground<3>>> == 5);
static_assert(rows_of_constraint<Cylindrical<Ground<3>, RigidBody<3>>> == 4);
static_assert(rows_of_constraint<Universal<Ground<3>, RigidBody<3>>> == 4);
static_assert(rows_of_constraint<Planar<Ground<3>, RigidBody<3>>> == 3);
static_assert(rows_of_constraint<Screw<Ground<3>, RigidBody<3>>> == 5);
static_assert(rows_of_constraint<Gear<RigidBody<2>, RigidBody<2>>> == 1);
static_assert(rows_of_constraint<RackAndPinion<RigidBody<3>, RigidBody<3>>> == 1);
static_assert(HolonomicConstraint<TurnCounter<Ground<3>, RigidBody<3>>>);
static_assert(PotentialForce<TorsionSpring<Ground<3>, RigidBody<3>>>);
static_assert(LawForce<TorsionDamper<Ground<3>, RigidBody<3>>>);

static_assert(NonholonomicConstraint<DiskRolling<Particle<3>, Particle<3>, Particle<3>>>);
static_assert(NonholonomicConstraint<KnifeEdge<Particle<2>, Particle<2>, Fixed<2>>>);
static_assert(NonholonomicConstraint<Pursuit<Particle<2>, Fixed<2>>>);
static_assert(NonholonomicConstraint<Rolling<Particle<2>, Fixed<2>, Fixed<2>>>);
static_assert(NonholonomicConstraint<UprightRolling<Particle<2>>>);
static_assert(rows_of_constraint<UprightRolling<Particle<2>>> == 2);

}  // namespace dalembert
