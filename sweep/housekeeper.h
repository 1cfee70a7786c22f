#pragma once

#include <dalembert/sweep/book.h>
#include <dalembert/sweep/progress.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace DALEMBERT_HIDDEN dalembert {

/// Beside the work: shows progress, puts the journal onto the disk, and publishes what is done now and then.
/// What goes wrong with that stops the book.
class Housekeeper {
 public:
  Housekeeper(Book& book, Progress& progress, const Journal& journal, std::function<void()> publish);
  Housekeeper(const Housekeeper&) = delete;
  Housekeeper& operator=(const Housekeeper&) = delete;
  ~Housekeeper();

 private:
  using Clock = std::chrono::steady_clock;
  void keep();
  void sync_if_due();
  void publish_if_due();

  Book& book_;
  Progress& progress_;
  const Journal& journal_;
  std::function<void()> publish_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool over_ = false;
  Clock::time_point synced_ = Clock::now(), published_ = synced_;
  std::chrono::duration<double> cost_{};  ///< of the last time that was published
  std::jthread thread_;                   ///< last: it uses all the others
};

}  // namespace dalembert
