#pragma once

#include <dalembert/sweep/book.h>
#include <dalembert/sweep/sweep.h>

#include <string>

namespace DALEMBERT_HIDDEN dalembert {

/// The work of a process: rows of chunks through the user's function.
struct Work {
  const Parameters& parameters;
  const RowFunction& row;
  Widths widths;

  /// One row; its error if it has one.
  void run(std::uint64_t row, Block& out) const;
  /// The rows of a chunk. Ends early at an interrupt, after twice the time that the chunk was meant to take,
  /// and where what is kept becomes large.
  [[nodiscard]] Block run(const Chunk& chunk) const;
};

/// How many threads this process may use, and can at all; 1 if the library was built without oneTBB.
[[nodiscard]] int usable_threads();
[[nodiscard]] int most_threads();
/// So many threads take chunks from the source until there are none.
void work_off(const Work& work, Source& source, int threads);
/// What one of them does. Throws nothing: what goes wrong stops the source.
void work_alone(const Work& work, Source& source, int worker) noexcept;

}  // namespace dalembert
