// A sweep to be killed: victim <file> <rows> <threads> [every so many rows one fails]. Prints its report.
#include <dalembert/tests/sweep/swing.h>

#include <cstdlib>
#include <iostream>

int main(int argc, char** argv) try {
  using namespace dalembert;
  using namespace dalembert::testing_sweeps;
  if (argc < 4) return 2;
  const auto number = [&](int i) { return i < argc ? std::strtoul(argv[i], nullptr, 10) : 0; };
  const SweepSummary summary =
      sweep(angles(number(2)), make_swing(number(4)), observe_swing(),
            {.file = argv[1], .run = swing_run, .threads = static_cast<int>(number(3)), .progress = false});
  if (summary.rank == 0) std::cout << summary.report() << std::endl;
  return summary.interrupted ? 3 : 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
