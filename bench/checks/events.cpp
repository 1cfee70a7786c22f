#include <dalembert/bench/checks/commands.h>
#include <dalembert/bench/models.h>
#include <dalembert/bench/table.h>

#include <cmath>
#include <iostream>

namespace dalembert::bench {

int events(const EventsOptions& options) {
  require_writable(options.report);
  Table table{
      .columns = {"model", "event", "stepper", "tolerance", "time", "reference_time", "error", "limit"},
      .rows = {}};
  int wrong = 0;
  for (const auto& model : models_of_events()) {
    for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
      for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
        for (const models::Timed& row : model.events({stepper, tolerance})) {
          const double error = std::abs(row.time.time - row.reference) / row.reference;
          if (!(error <= row.limit)) {  // nor is what did not happen
            ++wrong;
            std::cerr << "events: " << model.name << ", " << row.event << " by " << name(stepper) << " at "
                      << tolerance << " is not within its limit\n";
          }
          table.rows.push_back({model.name, row.event, name(stepper), shortest_power(tolerance),
                                scientific(row.time.time, 15), scientific(row.reference, 15),
                                scientific(error), scientific(row.limit)});
        }
      }
    }
  }
  report("Times of events against closed forms: relative errors", table, options.report);
  return wrong;
}

}  // namespace dalembert::bench
