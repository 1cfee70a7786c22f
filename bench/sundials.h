#pragma once

#include <string>

namespace dalembert::bench {

/// The SUNDIALS that is measured, as one line for a heading: its version, and a warning where it was compiled
/// without optimisation, as Debian's is.
[[nodiscard]] std::string sundials();

}  // namespace dalembert::bench
