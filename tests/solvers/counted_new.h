#pragma once

namespace dalembert {

/// How often this program has called operator new.
[[nodiscard]] long allocations();

}  // namespace dalembert
