#pragma once

#include <dalembert/bench/report.h>

#include <string>
#include <vector>

namespace dalembert::bench {

struct Extremes {
  std::vector<std::string> cases = {"all"};  ///< or names
  bool quick = false;                        ///< only the part of each sweep that takes seconds
  ReportOptions report;
};

/// How does it behave at the edges: right within a derived limit, or a refusal that says why? A row is right
/// if its error is within its limit, be its outcome "ok" or the refusal that is due there (its error is then
/// how far it is from the time or number that it ought to name). Returns the number of rows that are not.
int extremes(const Extremes& options);

}  // namespace dalembert::bench
