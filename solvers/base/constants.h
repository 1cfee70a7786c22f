#pragma once

#include <dalembert/solvers/base/hidden.h>

namespace DALEMBERT_HIDDEN dalembert {

/// The solvers' numbers that follow from nothing: what was judged, in one place, so that one can see and vary
/// them. What a formula or a table gives stands beside its formula. `dalembert-bench sensitivity` halves and
/// doubles each and shows what that does to errors and run times.
struct Constants {
  // ErkStepper. Step control as in Hairer, Norsett, Wanner, Solving ODEs I, II.4. With the usual safety of
  // 0.9 a quarter of the steps of a pendulum are repeated; 0.8 takes a sixth less time.
  double safety = 0.8;
  double most_growth = 6.0, most_shrinking = 0.2;
  double after_fault = 0.25;
  /// How much more than h a step may be, to end where output is wanted: what `safety` leaves room for.
  double stretch = 0.05;
  /// The first step, of the one that an error constant of 1 allows.
  double first_explicit_step = 0.3;
  /// A step goes back onto the constraints by about as much as it errs. One that has to be moved by more than
  /// this many times the tolerance went wrong: over a jump of a driven point, or onto another branch.
  double most_correction = 10.0;
  /// Roundings that such a correction may consist of, see State::round_off_of_projection.
  double roundings_of_projection = 10.0;
  /// The last stage, at t + h, and the end of a step have the same derivatives but for errors. Where these
  /// move the scene in a step by more than this part of its size, the step has jumped over something: a
  /// centre of force, whose two sides may deceive the error estimate.
  double most_disagreement = 0.05;
  /// A step that has to be so much shorter than usual meets something that is not smooth. There the estimate
  /// cannot be trusted: it weighs the first derivative a thousandth of what the step does.
  double far_too_short = 0.15, unreliable = 100.0;
  /// What is usual shrinks by at most so much a step.
  double forgetting = 0.9;

  // Close to singular positions.
  /// Constraints whose angle is smaller than this come into question for one.
  double close_to_dependent = 0.5;
  /// Stages are put onto the constraints if the angle changes in a step by more than this part of it.
  double changing_angle = 0.1;
  /// A singular position is where the angle falls to this part of what it was at the last node, or less: far
  /// below what a passage at a distance shows, far above what the extrapolated state is good for.
  double vanished = 1e-3;
  /// If it does not fall to this part it does not vanish. In between the extrapolation is too coarse to tell.
  double clearly_there = 0.2;
  /// Steps that are short against the time left look for it from here on.
  double in_sight = 0.1;
  /// Distances of nodes from the singular position grow by at least this, see Passage.
  double spread = 1.7;
  /// The implicit stepper hands over to the explicit one where the constraints come so close to dependent,
  /// and would be dependent after so many of its steps: it feels the errors of its states times 1/sin.
  double handover_sine = 0.1, handover_steps = 20.0;
  /// Where constraints repeat each other, those in use are chosen anew when the sine of the smallest angle
  /// among them has fallen to this part of what it was, if others are better by as much.
  double worn = 0.25;

  // IdaStepper.
  /// The error allowed to one step, of the tolerance asked for: errors of hundreds of steps add up in the
  /// result. With it every model of the catalogue errs by less than 1000 times the tolerance 1e-8.
  double share_of_a_step = 0.05;
  /// Newton stops at this fraction of that. IDA's 0.33 lets the multipliers' error into the step control.
  double newton_tolerance = 0.1;
  /// The first step, over the root of the tolerance. IDA's own is so short that round-off in the multipliers
  /// fails Newton's iteration.
  double first_implicit_step = 0.1;
  /// Of double precision, that Newton's iteration is not asked to better; see State::weigh.
  double roundings_of_newton = 5.0;
  /// Of Newton's corrections so many at most, and so many with the gradients of the predictor: the rest get
  /// fresh ones each. IDA's 4 in all are too few where links are short against what a step moves them.
  double most_corrections = 8.0, corrections_of_one_matrix = 3.0;
  /// Forces whose stiffness is below this part of M/h^2 are left out of Newton's matrix, until it fails.
  double soft = 0.1;
  /// Order 5 resolves a vibration that matters with steps h rho below the first (0.2 to 0.4 at tolerances
  /// 1e-4 to 1e-8); beyond the second no order is unstable. See OrderGuard.
  double resolved = 0.45, passed_over = 9.4;

  // Linear algebra.
  /// Rows that make a smaller angle than the root of this are left to LU on the whole matrix, so that the
  /// complement never loses more than half of the digits.
  double least_pivot = 1e-8;
  /// Pivots kept from an earlier matrix are given up when they make the condition this much worse.
  double tolerated_loss = 1e-3;

  // Start and output.
  /// Output is put onto the constraints to this fraction of the scene's length: a few roundings.
  double output_distance = 1e-15;
  /// Constraints that were left out because they followed from others at the start must still do so: to this
  /// fraction of the scene's length or speed.
  double tolerated_contradiction = 1e-8;
  /// Above this sine round-off cannot show: it is multiplied by at most the fourth power of its inverse.
  double well_conditioned = 0.1;
  /// Round-off of forces, in roundings, that must not count against the tolerance where only the path gives a
  /// length, see Scales::further.
  double roundings_of_path = 100.0;
  /// An instant after rest, of the scene's time: long enough for a direction, too short for a change.
  double instant_after = 1e-12;

  // Contacts and friction.
  /// Below so many roundings of the largest beside it a number is what some thousand operations leave of 0.
  double roundings_at_contacts = 1e4;
  /// So many tolerances of the scene's speed are rest for what slides in space, never more than the root. A
  /// step over the rest itself turns the friction while it lasts, and errs by a part of the speed it came
  /// with: steps that err by less than a tolerance pass none from so many. The way that is left is the
  /// square.
  double rest_in_space = 1000.0;
  /// Changes at one time, before they count as chattering.
  double most_at_one_time = 8.0;
  /// Changes of the scene that accumulate are an error where they follow each other in so many roots of the
  /// tolerance: what comes between two of them is to be in sight.
  double brief_changes = 10.0;

  // Equilibria and small motions.
  /// Of the largest stiffness over mass what counts as none: free motions get so much, so that Newton's
  /// matrix is regular.
  double no_stiffness = 1e-9;
  /// Newton's step is halved until the residual falls by this part of what a linear one would.
  double sufficient_decrease = 0.25;
  /// Of the scene's length, which a step downhill does not exceed.
  double longest_slide = 0.1;
  /// A step along a branch is given up at this part of the one asked for.
  double shortest_branch_step = 1e-3;
  /// Cosine of the angle below which two branches that leave one bifurcation are different.
  double alike = 0.98;
  /// Difference of the parameter, of its range, by which forces are differentiated.
  double parameter_difference = 1e-6;
  /// A parameter that pushes along the vanishing mode by less than this part of the forces that act makes a
  /// bifurcation, else a fold.
  double free_of_push = 1e-5;
  /// How far along a mode of eigenvalue 0 another equilibrium is looked for, of the scene's length.
  double free_way = 0.01;
  /// The lowest modes of many are those closest to this part of the largest stiffness over mass, below 0.
  double below_all = 1e-7;
};

/// Those of the library; `dalembert-bench sensitivity` is linked with others in their place.
extern const Constants& constants;

}  // namespace dalembert
