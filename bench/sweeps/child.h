#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace dalembert::bench {

/// Whether what a process says on stderr is seen: mpirun tells of kills at length.
enum class Errors { shown, hidden };

/// What a process takes its memory from. glibc's takes a lock for all but the first seven free blocks of each
/// size as soon as there is a second thread.
enum class Allocator { glibc, mimalloc };

/// This program once more, as a process of its own, perhaps by mpirun; in a group of its own, so that it can
/// be killed with all that belongs to it.
class Child {
 public:
  /// `ranks` 0: without mpirun.
  Child(const std::vector<std::string>& arguments, int ranks, Errors errors = Errors::shown,
        Allocator allocator = Allocator::glibc);
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child();

  /// Ends it, and all its ranks; or one of these, and so, by mpirun, the others.
  void kill_all() const;
  void kill_one(std::size_t which) const;
  /// Whether it ended well; `output` is then what it printed. What has said nothing for so many milliseconds
  /// is ended, unless they are negative: mpirun may lock itself up where a rank was killed.
  [[nodiscard]] bool wait(int patience = -1);
  [[nodiscard]] const std::string& output() const { return output_; }

 private:
  [[nodiscard]] std::vector<pid_t> children() const;

  pid_t id_ = 0;
  int pipe_ = -1;
  std::string output_{};
};

/// Whether there is an mpirun.
[[nodiscard]] bool has_mpirun();
/// Whether the allocator is on this machine.
[[nodiscard]] bool has(Allocator allocator);

}  // namespace dalembert::bench
