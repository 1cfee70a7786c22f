#pragma once

/// The whole library: states a scene, runs it, reads its motion and its forces of constraint.
#include <dalembert/constraints/coincident.h>
#include <dalembert/constraints/distance.h>
#include <dalembert/constraints/holonomic.h>
#include <dalembert/constraints/nonholonomic.h>
#include <dalembert/constraints/on_curve.h>
#include <dalembert/constraints/on_surface.h>
#include <dalembert/core/scene.h>
#include <dalembert/core/trajectory.h>
#include <dalembert/solvers/simulation.h>
