#pragma once

#include <dalembert/solvers/base/hidden.h>

namespace DALEMBERT_HIDDEN dalembert {

/// The solvers' empirical constants in one place, so that they can be seen and varied. What follows from a
/// formula or a table is kept beside it. `dalembert-bench sensitivity` halves and doubles each one and shows
/// the effect on errors and run times.
struct Constants {
  // ErkStepper. Step control as in Hairer, Norsett, Wanner, Solving ODEs I, II.4. With the usual safety
  // factor of 0.9 a quarter of a pendulum's steps are rejected; 0.8 takes a sixth less time.
  double safety = 0.8;
  double most_growth = 6.0, most_shrinking = 0.2;
  double after_fault = 0.25;
  /// How far a step may be stretched beyond h to end at an output time: what `safety` leaves room for.
  double stretch = 0.05;
  /// The first step, as a fraction of the one that an error constant of 1 allows.
  double first_explicit_step = 0.3;
  /// The projection after a step moves it by about its error. A step that it moves by more than this many
  /// times the tolerance went wrong: over a jump of a driven point, or onto another branch.
  double most_correction = 10.0;
  /// Units of round-off that such a correction, or the estimate of a step's error, may consist of, see
  /// ErkStepper::RungeKutta::round_off_of_projection and StepErrors::weigh.
  double roundings_of_step = 10.0;
  /// The last stage, at t + h, and the end of a step have the same derivatives up to errors. Where these move
  /// the scene in a step by more than this fraction of its size, the step has jumped over something: a centre
  /// of force, whose two sides may deceive the error estimate.
  double most_disagreement = 0.05;
  /// A step's error near a singularity, over what its null rules tell, see near_singularity: at most 58 on
  /// motions that are known.
  double quickening = 60.0;
  /// A step that has to be so much shorter than usual has reached something that is not smooth. The error
  /// estimate cannot be trusted there: it weights the first derivative by a thousandth of what the step does.
  double far_too_short = 0.15, unreliable = 100.0;
  /// The usual step shrinks by at most this factor per step.
  double step_memory = 0.9;

  // Close to singular positions.
  /// Constraints at a smaller angle than this may be approaching a singular position.
  double close_to_dependent = 0.5;
  /// Stages are projected onto the constraint manifold if the angle changes in a step by more than this part.
  double changing_angle = 0.1;
  /// At a singular position the angle falls to this fraction of its value at the last node, or less: far
  /// below what passing at a distance would show, far above the accuracy of the extrapolated state.
  double singular_ratio = 1e-3;
  /// If it does not fall to this part it does not vanish. In between, the extrapolation is too coarse to
  /// know.
  double regular_ratio = 0.2;
  /// Steps that are short compared with the time left look for it from here on.
  double search_sine = 0.1;
  /// The distances of nodes from the singular position grow by at least this factor, see
  /// SingularExtrapolation.
  double node_ratio = 1.7;
  /// The implicit stepper, which amplifies the errors of its states by 1/sin, hands over to the explicit one
  /// where the constraints are this close to dependent and would become so within this many of its steps.
  double handover_sine = 0.1, handover_steps = 20.0;
  /// Where constraints are redundant, the active rows are chosen anew when the sine of the smallest angle
  /// among them has fallen to this fraction of its earlier value, if other rows are better by as much.
  double row_exchange_ratio = 0.25;

  // IdaStepper.
  /// The error allowed per step, as a fraction of the tolerance asked for: errors of hundreds of steps add
  /// up. With it every model of the catalogue errs by less than 1000 times the tolerance 1e-8.
  double share_of_a_step = 0.05;
  /// Newton stops at this fraction of that. IDA's 0.33 lets the multipliers' error into the step control.
  double newton_tolerance = 0.1;
  /// The first step, over the root of the tolerance. IDA's own is so short that round-off in the multipliers
  /// makes Newton's iteration fail.
  double first_implicit_step = 0.1;
  /// Units of round-off below which Newton's iteration is not asked to converge; see
  /// IdaStepper::Solver::weigh.
  double roundings_of_newton = 5.0;
  /// Newton's corrections allowed in all, and with the gradients of the predictor: later ones evaluate them
  /// afresh. IDA's 4 in all are too few where links are short compared with the motion in a step.
  double most_corrections = 8.0, corrections_of_one_matrix = 3.0;
  /// Forces whose stiffness is below this fraction of M/h^2 are left out of Newton's matrix, until it fails.
  double soft = 0.1;
  /// Order 5 resolves a vibration that matters with steps h rho below the first (0.2 to 0.4 at tolerances
  /// 1e-4 to 1e-8); beyond the second no order is unstable. See OrderGuard.
  double resolved = 0.45, passed_over = 9.4;

  // Events and switches.
  /// A polynomial that disagrees with its function, where that is checked, by no more than this part of what
  /// it varies shows where it turns. Where it is not checked it may disagree so many times as much.
  double unresolved_by_interpolant = 1e-6, beside_a_kink = 30.0;

  // Linear algebra.
  /// Rows at a smaller angle than the root of this are left to LU of the whole matrix, so that the Schur
  /// complement never loses more than half of the digits.
  double least_pivot = 1e-8;
  /// Pivots kept from an earlier matrix are given up when they make the condition this much worse.
  double tolerated_loss = 1e-3;

  // Start and output.
  /// Output is projected onto the constraint manifold to this fraction of the scene's length: a few
  /// roundings.
  double output_distance = 1e-15;
  /// Constraints left out as linearly dependent at the start must remain satisfied: to this fraction of the
  /// scene's length or speed.
  double tolerated_contradiction = 1e-8;
  /// Above this sine round-off does not matter: it is amplified by at most its inverse fourth power.
  double well_conditioned = 0.1;
  /// Round-off of forces, in roundings, that must not count against the tolerance where only the path gives a
  /// length, see Scales::extended_by.
  double roundings_of_path = 100.0;
  /// An instant after rest, of the scene's time: long enough for a direction, too short for a change.
  double instant_after = 1e-12;

  // Contacts and friction.
  /// Below this many roundings of the largest beside it a number is what some thousand operations leave of 0.
  double roundings_at_contacts = 1e4;
  /// Two slip velocities come to rest in the direction that they have below this part of the root of the
  /// tolerance, of the scene's speed: what the turn of friction does in the rest of the way is of second
  /// order, a hundredth of the tolerance. Steps towards rest itself would become as short as the way left.
  double rest_in_space = 0.1;
  /// Changes at one instant beyond which they count as chattering.
  double most_at_one_time = 8.0;
  /// Accumulating changes of the scene are an error where they follow each other within this many roots of
  /// the tolerance: what happens between two of them is to be resolved.
  double brief_changes = 10.0;

  // Audit.
  /// By how many times more than the estimated errors of all steps the energy of a run may change, see
  /// WorkBalance: what they grow by with the motion.
  double growth = 10.0;

  // Equilibria and small motions.
  /// The stiffness over mass, as a fraction of the largest, that counts as none: free motions are given this
  /// much, so that Newton's matrix is regular.
  double no_stiffness = 1e-9;
  /// Newton's step is halved until the residual falls by this part of what a linear one would.
  double sufficient_decrease = 0.25;
  /// The longest step of descent, as a fraction of the scene's length.
  double longest_descent = 0.1;
  /// A continuation step is given up below this fraction of the one asked for.
  double shortest_branch_step = 1e-3;
  /// Cosine of the angle below which two branches that leave one bifurcation are distinct.
  double same_branch = 0.98;
  /// The step of difference quotients by the parameter, as a fraction of its range.
  double parameter_difference = 1e-6;
  /// How far along a mode of eigenvalue 0 another equilibrium is sought, as a fraction of the scene's length.
  double free_displacement = 0.01;
  /// The lowest modes of many are those closest to minus this part of the largest stiffness over mass.
  double shift_below_0 = 1e-7;
};

/// Those of the library; `dalembert-bench sensitivity` is linked with others instead.
extern const Constants& constants;

}  // namespace dalembert
