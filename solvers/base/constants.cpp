#include "dalembert/solvers/base/constants.h"

namespace dalembert {

namespace {
constexpr Constants judged;
}

const Constants& constants = judged;

}  // namespace dalembert
