#include "dalembert/solvers/base/constants.h"

namespace dalembert {

namespace {
constexpr Constants defaults;
}

const Constants& constants = defaults;

}  // namespace dalembert
