#pragma once

#include <dalembert/solvers/base/constants.h>

#include <array>
#include <string>

namespace dalembert::bench {

/// Those that the solvers are linked with here, see constants.cpp.
inline Constants varied;

struct NamedConstant {
  std::string name;
  double* value;
};

#define CONSTANT(name) \
  NamedConstant { #name, &varied.name }
/// Every empirical constant of the solvers.
inline const std::array named_constants = {
    CONSTANT(safety),
    CONSTANT(most_growth),
    CONSTANT(most_shrinking),
    CONSTANT(after_fault),
    CONSTANT(stretch),
    CONSTANT(first_explicit_step),
    CONSTANT(most_correction),
    CONSTANT(roundings_of_step),
    CONSTANT(most_disagreement),
    CONSTANT(quickening),
    CONSTANT(far_too_short),
    CONSTANT(unreliable),
    CONSTANT(step_memory),
    CONSTANT(close_to_dependent),
    CONSTANT(changing_angle),
    CONSTANT(singular_ratio),
    CONSTANT(regular_ratio),
    CONSTANT(search_sine),
    CONSTANT(node_ratio),
    CONSTANT(handover_sine),
    CONSTANT(handover_steps),
    CONSTANT(row_exchange_ratio),
    CONSTANT(share_of_a_step),
    CONSTANT(newton_tolerance),
    CONSTANT(first_implicit_step),
    CONSTANT(roundings_of_newton),
    CONSTANT(most_corrections),
    CONSTANT(corrections_of_one_matrix),
    CONSTANT(soft),
    CONSTANT(resolved),
    CONSTANT(passed_over),
    CONSTANT(least_pivot),
    CONSTANT(tolerated_loss),
    CONSTANT(output_distance),
    CONSTANT(tolerated_contradiction),
    CONSTANT(well_conditioned),
    CONSTANT(roundings_of_path),
    CONSTANT(instant_after),
    CONSTANT(growth),
    CONSTANT(no_stiffness),
    CONSTANT(sufficient_decrease),
    CONSTANT(longest_descent),
    CONSTANT(shortest_branch_step),
    CONSTANT(same_branch),
    CONSTANT(parameter_difference),
    CONSTANT(free_displacement),
    CONSTANT(shift_below_0),
    CONSTANT(roundings_at_contacts),
    CONSTANT(rest_in_space),
    CONSTANT(most_at_one_time),
    CONSTANT(brief_changes),
    CONSTANT(unresolved_by_interpolant),
    CONSTANT(beside_a_kink),
};
#undef CONSTANT
static_assert(sizeof(Constants) == std::tuple_size_v<decltype(named_constants)> * sizeof(double),
              "each constant is varied");

}  // namespace dalembert::bench
