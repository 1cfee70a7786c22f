#pragma once

namespace dalembert {

/// How often this program has called operator new.
[[nodiscard]] long allocations();

/// While it lives one call of operator new finds no memory, after so many that do.
class LackOfMemory {
 public:
  explicit LackOfMemory(long after);
  LackOfMemory(const LackOfMemory&) = delete;
  LackOfMemory& operator=(const LackOfMemory&) = delete;
  ~LackOfMemory();
  [[nodiscard]] bool came() const;
};

}  // namespace dalembert
