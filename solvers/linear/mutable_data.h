#pragma once

#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// KLU, LDL and AMD are in C and do not say what they leave as it is.
inline int* mutable_data(const std::vector<int>& x) { return const_cast<int*>(x.data()); }

}  // namespace dalembert
