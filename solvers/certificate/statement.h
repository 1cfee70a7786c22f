#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/certificate/largest_errors.h>

#include <string>

namespace DALEMBERT_HIDDEN dalembert {

/// What is known of a run's errors, and what is not, in words.
[[nodiscard]] std::string statement(const TwoRuns& runs, const LargestErrors& errors);

}  // namespace dalembert
