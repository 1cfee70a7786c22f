#include "dalembert/bench/sundials.h"

#include <dalembert/bench/processor_time.h>

#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace dalembert::bench {

namespace {

/// Fits the first-level cache, so that arithmetic is measured and not memory.
constexpr std::size_t length = 1000;
constexpr int repeats = 2000;

/// Least of several times, as what disturbs a measurement only ever adds to it.
template <class F>
double shortest(const F& f) {
  double least = std::numeric_limits<double>::infinity();
  for (int attempt = 0; attempt < 5; ++attempt) {
    const double begin = processor_time();
    for (int k = 0; k < repeats; ++k) f();
    least = std::min(least, processor_time() - begin);
  }
  return least;
}

/// How many times as long SUNDIALS takes for z = a x + b y as the same loop compiled here.
double slowness() {
  SUNContext context = nullptr;
#if SUNDIALS_VERSION_MAJOR >= 7
  SUNContext_Create(SUN_COMM_NULL, &context);
#else
  SUNContext_Create(nullptr, &context);
#endif
  std::vector<double> x(length, 1.0), y(length, 2.0), z(length);
  const auto n = static_cast<sunindextype>(length);
  N_Vector u = N_VMake_Serial(n, x.data(), context), v = N_VMake_Serial(n, y.data(), context),
           w = N_VMake_Serial(n, z.data(), context);
  const double theirs = shortest([&] { N_VLinearSum_Serial(3.0, u, 4.0, v, w); });
  const double ours = shortest([&] {
    for (std::size_t i = 0; i < length; ++i) z[i] = 3.0 * x[i] + 4.0 * y[i];
    asm volatile("" : : "r"(z.data()) : "memory");  // what is written is read, as far as the compiler knows
  });
  for (N_Vector each : {u, v, w}) N_VDestroy(each);
  SUNContext_Free(&context);
  return theirs / ours;
}

}  // namespace

std::string sundials() {
  const std::string version = std::string("SUNDIALS ") + SUNDIALS_VERSION;
  // Measured with this program at -O3: Debian's 7 times as long, the same loop at -O1 or -O2 1.8 to 3.3
  // times.
  if (slowness() < 4.0) return version;
  return version +
         ", compiled without optimisation: ida would take about a quarter less time with one's own, see "
         "docs/package.md";
}

}  // namespace dalembert::bench
