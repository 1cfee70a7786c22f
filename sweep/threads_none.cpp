#include <dalembert/sweep/worker.h>

namespace dalembert {

int usable_threads() { return 1; }

int most_threads() { return 1; }

void work_off(const Work& work, Source& source, int) { work_alone(work, source, 0); }

}  // namespace dalembert
