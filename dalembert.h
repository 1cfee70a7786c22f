#pragma once

/// The whole library: states a scene, runs it, reads its motion and its forces of constraint.
#include <dalembert/constraints/coincident.h>
#include <dalembert/constraints/disk_on_plane.h>
#include <dalembert/constraints/distance.h>
#include <dalembert/constraints/heading.h>
#include <dalembert/constraints/holonomic.h>
#include <dalembert/constraints/in_plane.h>
#include <dalembert/constraints/lamina.h>
#include <dalembert/constraints/line_offset.h>
#include <dalembert/constraints/moving.h>
#include <dalembert/constraints/nonholonomic.h>
#include <dalembert/constraints/on_curve.h>
#include <dalembert/constraints/on_surface.h>
#include <dalembert/constraints/prescribed.h>
#include <dalembert/constraints/pursuit.h>
#include <dalembert/constraints/rigid_body.h>
#include <dalembert/constraints/rolling.h>
#include <dalembert/constraints/thin_rod.h>
#include <dalembert/constraints/upright_rolling.h>
#include <dalembert/core/audit.h>
#include <dalembert/core/fields.h>
#include <dalembert/core/forces.h>
#include <dalembert/core/integrability.h>
#include <dalembert/core/scene.h>
#include <dalembert/core/trajectory.h>
#include <dalembert/solvers/simulation.h>
