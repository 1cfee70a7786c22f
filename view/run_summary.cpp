#include "dalembert/view/run_summary.h"

#include <dalembert/solvers/certificate/largest_errors.h>
#include <dalembert/solvers/certificate/statement.h>

namespace dalembert {

void write_events(Json& json, const Record& run, const TwoRuns* certified, std::span<const Shown> shown) {
  std::size_t row = 0;
  json.list("events", Places::from(0, run.events.size()), [&](std::size_t k) {
    const EventRecord& one = run.events[k];
    while (row < shown.size() && shown[row].event != k) ++row;
    json.object([&] {
      json.member("name", run.name_of(one));
      json.member("what", name(one.kind));
      json.member("time", one.time);
      if (row < shown.size()) json.member("row", row);
      if (one.kind != EventKind::event) json.member("constraint", one.source);
      if (certified != nullptr) json.member("error", certified->error_of_time(k));
    });
  });
}

void write_statistics(Json& json, const Statistics& s) {
  json.object("statistics", [&] {
    json.member("degrees of freedom", s.degrees_of_freedom);
    json.member("redundant equations", s.redundant_equations);
    json.member("singular positions", s.singular_positions);
    json.member("accuracy", s.accuracy);
    json.member("round-off", s.round_off);
    json.member("steps", s.steps);
    json.member("evaluations", s.evaluations);
    json.member("factorisations", s.factorisations);
    json.member("error test failures", s.error_test_failures);
    json.member("convergence failures", s.convergence_failures);
    json.member("stability-limited steps", s.stability_limited);
    json.member("linear algebra", s.linear_algebra);
    json.member("length of the scene", s.length);
    json.member("time of the scene", s.time);
    json.member("residual of positions", s.residual_position);
    json.member("residual of velocities", s.residual_velocity);
    json.member("correction", s.correction);
    json.member("processor time [s]", s.run_time);
    json.member("advice", s.advice);
  });
  json.list("audit", s.audit.worst, [&](const Finding& finding) {
    json.object([&] {
      json.member("law", name(finding.law));
      json.member("element", finding.element);
      json.member("time", finding.time);
      json.member("size", finding.size);
      json.member("limit", finding.limit);
    });
  });
}

void write_certificate(Json& json, const TwoRuns* certified) {
  if (certified == nullptr) return;
  json.object("certificate", [&] {
    json.member("statement", statement(*certified, largest_errors(*certified)));
    json.member("complete", certified->complete());
    json.member("knownUntil", certified->known_until());
  });
}

}  // namespace dalembert
