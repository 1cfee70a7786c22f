#pragma once

#include <dalembert/bench/method.h>
#include <dalembert/bench/report.h>
#include <dalembert/models/model.h>

#include <string>
#include <vector>

namespace dalembert::bench {

struct WorkPrecision {
  std::vector<std::string> models = {"all"};     ///< names of the catalogue, or "all"
  std::vector<Method> steppers = {Method::ida};  ///< those that a model does not have give no row
  std::vector<double> tolerances = {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
  int samples = 101;  ///< equally spaced; 2, the ends of the run, times the integration alone
  int repeats = 3;    ///< the run time reported is the median of this many runs
  ReportOptions report;
};

/// How much run time does an error cost? Runs models over falling tolerances and compares each
/// with its hand derivation. A run that was refused has its outcome in the table, and nan for errors.
/// Throws Error for a name or a tolerance that makes no sense, before anything is run.
void work_precision(const WorkPrecision& options);

/// The models of these names, in the order of the catalogue; throws Error, listing the names, for one
/// that does not exist.
[[nodiscard]] std::vector<models::AnyModel> select_models(const std::vector<std::string>& names);

}  // namespace dalembert::bench
