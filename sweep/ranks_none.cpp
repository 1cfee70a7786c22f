#include <dalembert/sweep/ranks.h>

namespace dalembert {

std::unique_ptr<Ranks> join_ranks() { return std::make_unique<Ranks>(); }

}  // namespace dalembert
