#include "dalembert/sweep/housekeeper.h"

#include <exception>
#include <utility>

namespace dalembert {

namespace {
using namespace std::chrono_literals;
}

Housekeeper::Housekeeper(Book& book, Progress& progress, const Journal& journal,
                         std::function<void()> publish)
    : book_(book), progress_(progress), journal_(journal), publish_(std::move(publish)), thread_([this] {
        keep();
      }) {}

Housekeeper::~Housekeeper() {
  {
    const std::scoped_lock lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
}

void Housekeeper::keep() {
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, 200ms, [this] { return over_; })) {
    progress_.show(book_.counts());
    try {
      sync_if_due();
      publish_if_due();
    } catch (const std::exception& error) {
      book_.stop(error.what());
    }
  }
}

void Housekeeper::sync_if_due() {
  if (Clock::now() - synced_ < 1s) return;
  journal_.sync();
  synced_ = Clock::now();
}

/// Once a minute, but in at most a fiftieth of the time.
void Housekeeper::publish_if_due() {
  const auto start = Clock::now();
  if (start - published_ < 1min || start - published_ < 50 * cost_) return;
  publish_();
  published_ = Clock::now();
  cost_ = published_ - start;
}

}  // namespace dalembert
