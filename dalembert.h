#pragma once

/// The whole library. Points, forces, a scene:
#include <dalembert/core/points/points.h>
/// its results and analysis;
#include <dalembert/core/analysis/integrability.h>
#include <dalembert/core/analysis/virtual_work.h>
#include <dalembert/core/forces/fields.h>
#include <dalembert/core/forces/forces.h>
#include <dalembert/core/forces/friction.h>
#include <dalembert/core/lagrange/embedding.h>
#include <dalembert/core/lagrange/routhian.h>
#include <dalembert/core/results/ledger.h>
#include <dalembert/core/results/trajectory.h>
#include <dalembert/core/scene/scene.h>
/// constraints, and the bodies that they hold together;
#include <dalembert/constraints/bodies/lamina.h>
#include <dalembert/constraints/bodies/motion.h>
#include <dalembert/constraints/bodies/rigid_body.h>
#include <dalembert/constraints/bodies/thin_rod.h>
#include <dalembert/constraints/coincident.h>
#include <dalembert/constraints/compliant.h>
#include <dalembert/constraints/coulomb.h>
#include <dalembert/constraints/disk_on_plane.h>
#include <dalembert/constraints/distance.h>
#include <dalembert/constraints/geometry/moving.h>
#include <dalembert/constraints/holonomic.h>
#include <dalembert/constraints/joints/cylindrical.h>
#include <dalembert/constraints/joints/drives.h>
#include <dalembert/constraints/joints/gear.h>
#include <dalembert/constraints/joints/joint.h>
#include <dalembert/constraints/joints/planar.h>
#include <dalembert/constraints/joints/prismatic.h>
#include <dalembert/constraints/joints/rack_and_pinion.h>
#include <dalembert/constraints/joints/revolute.h>
#include <dalembert/constraints/joints/screw.h>
#include <dalembert/constraints/joints/torsion.h>
#include <dalembert/constraints/joints/turn_counter.h>
#include <dalembert/constraints/joints/universal.h>
#include <dalembert/constraints/joints/weld.h>
#include <dalembert/constraints/knife_edge.h>
#include <dalembert/constraints/nonholonomic.h>
#include <dalembert/constraints/on_curve.h>
#include <dalembert/constraints/on_surface.h>
#include <dalembert/constraints/point_line_distance.h>
#include <dalembert/constraints/prescribed.h>
#include <dalembert/constraints/pursuit.h>
#include <dalembert/constraints/rolling.h>
#include <dalembert/constraints/rotating_plane.h>
#include <dalembert/constraints/slip.h>
#include <dalembert/constraints/unilateral.h>
#include <dalembert/constraints/upright_rolling.h>
/// running it;
#include <dalembert/solvers/simulation.h>
/// with the errors of all that it gives;
#include <dalembert/solvers/certificate/report.h>
#include <dalembert/solvers/certificate/simulate_to.h>
#include <dalembert/solvers/certificate/work_precision.h>
/// the same from a Lagrangian, and each checked by the other;
#include <dalembert/solvers/lagrange/cross_check.h>
#include <dalembert/solvers/lagrange/lagrangian_certificate.h>
/// and where it stays, and how it moves about there.
#include <dalembert/solvers/equilibrium/branches.h>
#include <dalembert/solvers/equilibrium/equilibrium.h>
#include <dalembert/solvers/equilibrium/floquet.h>
#include <dalembert/solvers/equilibrium/normal_modes.h>
#include <dalembert/solvers/equilibrium/steady.h>
#include <dalembert/solvers/equilibrium/steady_branches.h>
