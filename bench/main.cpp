#include <dalembert/bench/leave_out.h>
#include <dalembert/bench/own_constraint.h>
#include <dalembert/bench/ratios.h>
#include <dalembert/bench/scaling.h>
#include <dalembert/bench/table.h>
#include <dalembert/bench/work_precision.h>
#include <dalembert/models/catalogue.h>

#include <CLI/CLI.hpp>

#include <iostream>
#include <map>

namespace {

using namespace dalembert;

void list() {
  bench::Table table{.columns = {"model", "notes", "reference"}, .rows = {}};
  for (const models::AnyModel& any : models::catalogue())
    std::visit([&](const auto& m) { table.rows.push_back({m.name, m.notes, m.reference}); }, any);
  table.print(std::cout);
}

void add_report_options(CLI::App& command, bench::ReportOptions& options) {
  command.add_option("--csv", options.csv,
                     "Also write the table to this file, and the same for readers beside it as .txt");
  command.add_option("--note", options.note, "A line for the heading, such as the commit");
}

void add_steppers(CLI::App& command, std::vector<Stepper>& steppers) {
  const std::map<std::string, Stepper> known{{name(Stepper::ida), Stepper::ida},
                                             {name(Stepper::erk), Stepper::erk}};
  command.add_option("--stepper", steppers, "ida, erk; both unless given")
      ->delimiter(',')
      ->transform(CLI::CheckedTransformer(known).description("{ida, erk}"));
}

void add_contenders(CLI::App& command, std::vector<bench::Contender>& steppers) {
  std::map<std::string, bench::Contender> known;
  std::string names;
  for (const bench::Contender contender : bench::contenders()) {
    known.emplace(bench::name(contender), contender);
    names += (names.empty() ? "" : ", ") + std::string(bench::name(contender));
  }
  std::string chosen = steppers.size() == known.size() ? "all" : bench::name(steppers.front());
  command.add_option("--stepper", steppers, names + "; " + chosen + " unless given")
      ->delimiter(',')
      ->transform(CLI::CheckedTransformer(known).description("{" + names + "}"));
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"Benchmarks of dalembert"};
  app.require_subcommand(1);

  CLI::App* listing = app.add_subcommand("list", "Name, lecture notes' number and reference of every model");

  bench::WorkPrecision ladder;
  CLI::App* work_precision = app.add_subcommand(
      "work-precision",
      "Errors of motion and of forces of constraint against run time, over a ladder of tolerances");
  work_precision->add_option("--model", ladder.models, "all, or names as in `list`")
      ->delimiter(',')
      ->capture_default_str();
  add_contenders(*work_precision, ladder.steppers);
  work_precision->add_option("--tolerance", ladder.tolerances, "Between 1e-13 and 0.1")
      ->delimiter(',')
      ->capture_default_str();
  work_precision->add_option("--repeat", ladder.repeats, "Runs of which the median time counts")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  work_precision
      ->add_option("--samples", ladder.samples,
                   "Equally spaced, at which errors are taken; 2, the ends, times the integration alone")
      ->capture_default_str();
  add_report_options(*work_precision, ladder.report);

  bench::Scaling sizes;
  CLI::App* scaling = app.add_subcommand("scaling", "Run time and peak memory against the size of a scene");
  scaling->add_option("--model", sizes.model, "chain")->capture_default_str();
  scaling
      ->add_option("--size", sizes.sizes,
                   "Beads; up to " + std::to_string(bench::largest_compared) +
                       " the error is that of the last positions, above it is nan")
      ->delimiter(',')
      ->check(CLI::Range(1, 100'000'000))
      ->capture_default_str();
  add_contenders(*scaling, sizes.steppers);
  scaling->add_option("--tolerance", sizes.tolerance, "Between 1e-13 and 0.1")->capture_default_str();
  scaling->add_option("--t-end", sizes.t_end, "Length of the run [s]")->capture_default_str();
  add_report_options(*scaling, sizes.report);

  bench::OwnConstraint own;
  CLI::App* own_constraint = app.add_subcommand(
      "own-constraint", "Run time of a chain whose rods are a user's lambdas against one of Distances");
  own_constraint->add_option("--size", own.beads, "Beads")->check(CLI::PositiveNumber)->capture_default_str();
  own_constraint->add_option("--repeat", own.repeats, "Pairs of runs of which the median ratio counts")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  add_steppers(*own_constraint, own.steppers);
  add_report_options(*own_constraint, own.report);

  bench::LeaveOut without;
  CLI::App* leave_out = app.add_subcommand(
      "leave-out", "Run time of scenes stated in full against the same motion without what it does not need");
  leave_out->add_option("--size", without.size, "Beads of the chains, and number of islands")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  leave_out->add_option("--repeat", without.repeats, "Pairs of runs of which the median times count")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  leave_out->add_option("--tolerance", without.tolerance, "Between 1e-13 and 0.1")->capture_default_str();
  add_steppers(*leave_out, without.steppers);
  add_report_options(*leave_out, without.report);
  bench::Ratios race;
  CLI::App* ratios = app.add_subcommand(
      "ratios", "Time to reach an error at the end of a run, against code derived by hand and against peers");
  ratios->add_option("--scene", race.scenes, "all, or some of " + bench::known_scenes())
      ->delimiter(',')
      ->capture_default_str();
  add_contenders(*ratios, race.steppers);
  ratios->add_option("--error", race.errors, "Of position, relative to the system's length")
      ->delimiter(',')
      ->check(CLI::Range(1e-10, 1e-2))
      ->capture_default_str();
  ratios->add_option("--repeat", race.repeats, "Rounds, of which the median time counts")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  ratios
      ->add_option("--limit", race.limit,
                   "A stepper whose run took longer than this [s] is not tried at tighter tolerances")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_report_options(*ratios, race.report);

  CLI11_PARSE(app, argc, argv);
  int failures = 0;
  if (*listing) list();
  if (*work_precision) failures = bench::work_precision(ladder);
  if (*own_constraint) bench::own_constraint(own);
  if (*leave_out) failures = bench::leave_out(without);
  if (*ratios) bench::ratios(race);
  if (*scaling) failures = bench::scaling(sizes);
  return failures == 0 ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << "dalembert-bench: " << error.what() << '\n';
  return 2;
}
