#include <dalembert/sweep/worker.h>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <cstddef>

namespace dalembert {

int usable_threads() { return tbb::info::default_concurrency(); }

int most_threads() { return 1024; }

/// A task for each thread, that lasts until there is no more work: if oneTBB gives fewer threads, those that
/// there are do it all.
void work_off(const Work& work, Source& source, int threads) {
  if (threads == 1) return work_alone(work, source, 0);
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism,
                                 static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(
        0, threads, [&](int worker) { work_alone(work, source, worker); }, tbb::simple_partitioner());
  });
}

}  // namespace dalembert
