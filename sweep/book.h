#pragma once

#include <dalembert/sweep/block.h>
#include <dalembert/sweep/journal.h>

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Rows handed out to a worker, and how long they are meant to take.
struct Chunk {
  Interval rows{};
  double seconds = 0.0;
};

/// Where a worker gets chunks and hands in what became of them: the book itself, or through MPI.
class Source {
 public:
  virtual ~Source() = default;
  /// Waits while others may still give rows back; nothing once there is no more to do.
  virtual std::optional<Chunk> next(int worker) = 0;
  /// The rows of `chunk` that `block` does not hold are given back.
  virtual void enter(const Chunk& chunk, const Block& block) = 0;
  /// Something went wrong that is no row's: all workers are to end.
  virtual void stop(const std::string& error) = 0;
};

/// Which rows are done, in work and to do; all calls by any thread. There is one, in the first process.
///
/// Chunks are so large that they take `chunk_seconds`, by the mean of the rows so far: of the first a row,
/// and towards the end half of what is left for each worker (guided self-scheduling: Polychronopoulos, Kuck
/// 1987).
class Book : public Source {
 public:
  Book(Journal& journal, std::uint64_t rows, int workers);

  std::optional<Chunk> next(int worker) override;
  void enter(const Chunk& chunk, const Block& block) override;
  void stop(const std::string& error) override;
  /// `next` without waiting.
  enum class State { work, wait, end };
  [[nodiscard]] State try_next(Chunk& chunk);

  struct Counts {
    std::uint64_t done = 0, failed = 0;
  };
  [[nodiscard]] Counts counts() const;
  [[nodiscard]] double chunk_seconds() const { return chunk_seconds_; }
  [[nodiscard]] std::string error() const;  ///< empty if there is none
  [[nodiscard]] std::vector<Journal::Entry> entries() const;

 private:
  State take(Chunk& chunk);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Journal& journal_;
  int workers_;
  double chunk_seconds_;
  std::vector<Interval> to_do_;  ///< the next one last
  std::uint64_t left_ = 0;       ///< rows in to_do_
  std::uint64_t in_work_ = 0;    ///< chunks
  Counts counts_;
  std::uint64_t timed_ = 0;  ///< rows whose time is in seconds_
  double seconds_ = 0.0;
  std::string error_;
};

}  // namespace dalembert
