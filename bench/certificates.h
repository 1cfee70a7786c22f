#pragma once

#include <dalembert/bench/report.h>

#include <vector>

namespace dalembert::bench {

struct CertificatesTable {
  std::vector<double> tolerances = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10};
  bool quick = false;  ///< two tolerances
  ReportOptions report;
};

/// How true are the errors that `certify` estimates? Compares them with the true ones of every model that has
/// a reference, by both steppers, and with closed forms of the times of events and impulses. Returns how many
/// of its claims fail: the shares of estimates within 0.8 to 1.25 and 0.2 to 5 times the true error, and the
/// cost.
[[nodiscard]] int certificates(const CertificatesTable& options);

}  // namespace dalembert::bench
