#pragma once

#include <dalembert/sweep/book.h>

#include <memory>
#include <string>

namespace DALEMBERT_HIDDEN dalembert {

/// The processes that share a sweep: those that mpirun started, or this one alone.
class Ranks {
 public:
  virtual ~Ranks() = default;
  [[nodiscard]] virtual int rank() const { return 0; }
  [[nodiscard]] virtual int size() const { return 1; }
  /// What the first one says, to all. Called by all.
  [[nodiscard]] virtual std::string broadcast(std::string text) { return text; }
  [[nodiscard]] virtual int sum(int value) { return value; }  ///< over all; called by all
  /// In the first process: hands out and takes in for the others, until they have all ended.
  virtual void serve(Book&) {}
  /// In the others: the book of the first.
  [[nodiscard]] virtual std::unique_ptr<Source> source() { return nullptr; }
  /// Tells the first that this one has ended; nothing of `source` may follow.
  virtual void leave() {}
};

[[nodiscard]] std::unique_ptr<Ranks> join_ranks();

}  // namespace dalembert
