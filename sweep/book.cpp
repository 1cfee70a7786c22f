#include "dalembert/sweep/book.h"

#include <dalembert/core/errors.h>
#include <dalembert/sweep/interrupt.h>

#include <algorithm>

namespace dalembert {

namespace {

/// A chunk costs tens of microseconds to hand out, send and write (docs/sweeps.md): at 0.1 s a thousandth of
/// its work. With many workers chunks are longer, so that the book is busy for at most some hundredths of the
/// time. Both may be ten times as large or small with no effect but on what a kill loses.
double seconds_of_chunks(int workers) { return std::max(0.1, 1e-3 * workers); }

/// What one block may hold in memory.
constexpr std::uint64_t most_rows = 1 << 16;

}  // namespace

Book::Book(Journal& journal, std::uint64_t rows, int workers)
    : journal_(journal), workers_(workers), chunk_seconds_(seconds_of_chunks(workers)) {
  auto done = journal.entries();
  std::ranges::sort(done, {}, [](const auto& entry) { return entry.rows.first; });
  std::uint64_t at = 0;
  for (const auto& entry : done) {
    if (entry.rows.first < at) throw Error("journal of a sweep: a row stands in it twice; it is damaged");
    if (entry.rows.first > at) to_do_.push_back({at, entry.rows.first - at});
    at = entry.rows.end();
    counts_.done += entry.rows.count;
    counts_.failed += entry.failures;
  }
  if (at < rows) to_do_.push_back({at, rows - at});
  std::ranges::reverse(to_do_);
  left_ = rows - counts_.done;
}

Book::State Book::take(Chunk& chunk) {
  if (!error_.empty() || Interrupt::noted()) return State::end;
  if (to_do_.empty()) return in_work_ > 0 ? State::wait : State::end;
  // A worker begins with a row, and takes no more than twice what is known to take the time.
  std::uint64_t count = 1;
  if (seconds_ > 0.0) {
    const double meant = chunk_seconds_ * static_cast<double>(timed_) / seconds_;
    count = std::min({meant < static_cast<double>(most_rows) ? static_cast<std::uint64_t>(meant) : most_rows,
                      2 * timed_, left_ / (2 * static_cast<std::uint64_t>(workers_))});
  }
  Interval& first = to_do_.back();
  count = std::clamp<std::uint64_t>(count, 1, first.count);
  chunk = {{first.first, count}, chunk_seconds_};
  first = {first.first + count, first.count - count};
  if (first.count == 0) to_do_.pop_back();
  left_ -= count;
  ++in_work_;
  return State::work;
}

Book::State Book::try_next(Chunk& chunk) {
  const std::scoped_lock lock(mutex_);
  return take(chunk);
}

std::optional<Chunk> Book::next(int) {
  std::unique_lock lock(mutex_);
  Chunk chunk;
  State state = State::wait;
  changed_.wait(lock, [&] { return (state = take(chunk)) != State::wait; });
  if (state == State::end) return std::nullopt;
  return chunk;
}

void Book::enter(const Chunk& chunk, const Block& block) {
  const std::scoped_lock lock(mutex_);
  --in_work_;
  if (block.rows.count < chunk.rows.count) {
    to_do_.push_back({block.rows.end(), chunk.rows.end() - block.rows.end()});
    left_ += to_do_.back().count;
  }
  if (block.rows.count > 0 && error_.empty()) {
    try {
      journal_.append(block);
      counts_.done += block.rows.count;
      counts_.failed += block.failures;
      timed_ += block.rows.count;
      seconds_ += block.seconds;
    } catch (const Error& error) {
      error_ = error.what();
    }
  }
  changed_.notify_all();
}

void Book::stop(const std::string& error) {
  const std::scoped_lock lock(mutex_);
  if (error_.empty()) error_ = error;
  changed_.notify_all();
}

Book::Counts Book::counts() const {
  const std::scoped_lock lock(mutex_);
  return counts_;
}

std::string Book::error() const {
  const std::scoped_lock lock(mutex_);
  return error_;
}

std::vector<Journal::Entry> Book::entries() const {
  const std::scoped_lock lock(mutex_);
  return journal_.entries();
}

}  // namespace dalembert
