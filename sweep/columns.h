#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/sweep/parameters.h>

#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Throws InvalidArgument for a column without a name, and for two of one name, also of those in `taken`;
/// `what` is the word for them.
void require_distinct(const std::string& what, const std::vector<Quantity>& columns,
                      const std::vector<Quantity>& taken = {});

}  // namespace dalembert
