#include <dalembert/bench/audit.h>
#include <dalembert/bench/certificates.h>
#include <dalembert/bench/diagrams.h>
#include <dalembert/bench/events.h>
#include <dalembert/bench/extremes.h>
#include <dalembert/bench/leave_out.h>
#include <dalembert/bench/modes.h>
#include <dalembert/bench/own_constraint.h>
#include <dalembert/bench/pages.h>
#include <dalembert/bench/ratios.h>
#include <dalembert/bench/requests.h>
#include <dalembert/bench/scaling.h>
#include <dalembert/bench/table.h>
#include <dalembert/bench/work_precision.h>
#include <dalembert/models/catalogue.h>

#include <CLI/CLI.hpp>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <map>
#include <memory>

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

void add_methods(CLI::App& command, std::vector<bench::Method>& steppers) {
  std::map<std::string, bench::Method> known;
  std::string names;
  for (const bench::Method method : bench::all_methods()) {
    known.emplace(bench::name(method), method);
    names += (names.empty() ? "" : ", ") + std::string(bench::name(method));
  }
  std::string chosen = steppers.size() == known.size() ? "all" : bench::name(steppers.front());
  command.add_option("--stepper", steppers, names + "; " + chosen + " unless given")
      ->delimiter(',')
      ->transform(CLI::CheckedTransformer(known).description("{" + names + "}"));
}

/// Each command keeps its options and runs when CLI11 has parsed them; `failures` counts rows that are wrong;
/// a refused run is none.
void add_list(CLI::App& app) {
  app.add_subcommand("list", "Name, lecture notes' number and reference of every model")->callback(list);
}

void add_work_precision(CLI::App& app) {
  const auto options = std::make_shared<bench::WorkPrecision>();
  CLI::App* command = app.add_subcommand(
      "work-precision",
      "Errors of motion and of forces of constraint against run time, over falling tolerances");
  command->add_option("--model", options->models, "all, or names as in `list`")
      ->delimiter(',')
      ->capture_default_str();
  add_methods(*command, options->steppers);
  command->add_option("--tolerance", options->tolerances, "Between 1e-13 and 0.1")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--repeat", options->repeats, "Runs of which the median time counts")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  command
      ->add_option("--samples", options->samples,
                   "Equally spaced, at which errors are taken; 2, the ends, times the integration alone")
      ->capture_default_str();
  add_report_options(*command, options->report);
  command->callback([options] { bench::work_precision(*options); });
}

void add_scaling(CLI::App& app) {
  const auto options = std::make_shared<bench::Scaling>();
  CLI::App* command = app.add_subcommand("scaling", "Run time and peak memory against the size of a scene");
  command->add_option("--model", options->model, "chain")->capture_default_str();
  command
      ->add_option("--size", options->sizes,
                   "Beads; up to " + std::to_string(bench::largest_compared) +
                       " the error is that of the last positions, above it is nan")
      ->delimiter(',')
      ->check(CLI::Range(1, 100'000'000))
      ->capture_default_str();
  add_methods(*command, options->steppers);
  command->add_option("--tolerance", options->tolerance, "Between 1e-13 and 0.1")->capture_default_str();
  command->add_option("--t-end", options->t_end, "Length of the run [s]")->capture_default_str();
  add_report_options(*command, options->report);
  command->callback([options] { bench::scaling(*options); });
}

void add_own_constraint(CLI::App& app) {
  const auto options = std::make_shared<bench::OwnConstraint>();
  CLI::App* command = app.add_subcommand(
      "own-constraint", "Run time of a chain whose rods are a user's lambdas against one of Distances");
  command->add_option("--size", options->beads, "Beads")->check(CLI::PositiveNumber)->capture_default_str();
  command->add_option("--repeat", options->repeats, "Pairs of runs of which the median ratio counts")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  add_steppers(*command, options->steppers);
  add_report_options(*command, options->report);
  command->callback([options] { bench::own_constraint(*options); });
}

void add_leave_out(CLI::App& app, int& failures) {
  const auto options = std::make_shared<bench::LeaveOut>();
  CLI::App* command = app.add_subcommand(
      "leave-out", "Run time of scenes stated in full against the same motion without what it does not need");
  command->add_option("--size", options->size, "Beads of the chains, and number of islands")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  command->add_option("--repeat", options->repeats, "Pairs of runs of which the median times count")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  command->add_option("--tolerance", options->tolerance, "Between 1e-13 and 0.1")->capture_default_str();
  add_steppers(*command, options->steppers);
  add_report_options(*command, options->report);
  command->callback([options, &failures] { failures = bench::leave_out(*options); });
}

void add_ratios(CLI::App& app) {
  const auto options = std::make_shared<bench::Ratios>();
  CLI::App* command = app.add_subcommand(
      "ratios", "Time to reach an error at the end of a run, against code derived by hand and against peers");
  command->add_option("--scene", options->scenes, "all, or some of " + bench::known_scenes())
      ->delimiter(',')
      ->capture_default_str();
  add_methods(*command, options->steppers);
  command->add_option("--error", options->errors, "Of position, relative to the system's length")
      ->delimiter(',')
      ->check(CLI::Range(1e-10, 1e-2))
      ->capture_default_str();
  command->add_option("--repeat", options->repeats, "Rounds, of which the median time counts")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  command
      ->add_option("--limit", options->limit,
                   "A stepper whose run took longer than this [s] is not tried at tighter tolerances")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_report_options(*command, options->report);
  command->callback([options] { bench::ratios(*options); });
}

void add_extremes(CLI::App& app, int& failures) {
  const auto options = std::make_shared<bench::Extremes>();
  CLI::App* command = app.add_subcommand(
      "extremes", "Stiff, extreme and hostile scenes: error against its limit, or the refusal that is due");
  command->add_option("--case", options->cases, "all, or names as in the table")
      ->delimiter(',')
      ->capture_default_str();
  command->add_flag("--quick", options->quick, "Only the part of each sweep that takes seconds");
  add_report_options(*command, options->report);
  command->callback([options, &failures] { failures = bench::extremes(*options); });
}

void add_audit(CLI::App& app, int& failures) {
  const auto options = std::make_shared<bench::AuditTable>();
  CLI::App* command = app.add_subcommand(
      "audit",
      "Every law of mechanics that a result must obey against its limit, in all models and extremes");
  command->add_option("--tolerance", options->tolerances, "Between 1e-13 and 0.1")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--repeat", options->repeats, "Pairs of runs of which the median cost counts; 0: none")
      ->check(CLI::Range(0, 10'000))
      ->capture_default_str();
  command->add_flag("--quick", options->quick, "Of the extremes only the part that takes seconds");
  add_report_options(*command, options->report);
  command->callback([options, &failures] { failures = bench::audit(*options); });
}

void add_modes(CLI::App& app, int& failures) {
  const auto options = std::make_shared<bench::ModesTable>();
  CLI::App* command = app.add_subcommand(
      "modes", "Equilibria, forces of constraint there and small motions against closed forms");
  command->add_option("--size", options->beads, "Beads of the long chain")
      ->check(CLI::Range(300, 1'000'000))
      ->capture_default_str();
  add_report_options(*command, options->report);
  command->callback([options, &failures] { failures = bench::modes(*options); });
}

void add_events(CLI::App& app, int& failures) {
  const auto options = std::make_shared<bench::EventsTable>();
  CLI::App* command = app.add_subcommand(
      "events", "Times of impacts, of rest and of forces that vanish against closed forms");
  add_report_options(*command, options->report);
  command->callback([options, &failures] { failures = bench::events(*options); });
}

void add_certificates(CLI::App& app, int& failures) {
  const auto options = std::make_shared<bench::CertificatesTable>();
  CLI::App* command = app.add_subcommand(
      "certificates", "Errors that certify estimates against the true ones, in all models and events");
  command->add_option("--tolerance", options->tolerances, "Between 1e-13 and 0.1")
      ->delimiter(',')
      ->capture_default_str();
  command->add_flag("--quick", options->quick, "Two tolerances only");
  add_report_options(*command, options->report);
  command->callback([options, &failures] { failures = bench::certificates(*options); });
}

void add_requests(CLI::App& app, int& failures) {
  const auto options = std::make_shared<bench::RequestsTable>();
  CLI::App* command = app.add_subcommand(
      "requests", "Errors of force that simulate_to is asked for, what it gives, and at what cost");
  command->add_option("--model", options->models, "all, or names as in `list`")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--error", options->errors, "Of force, relative to the model's")
      ->delimiter(',')
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--repeat", options->repeats, "Runs of which the median time counts")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  add_report_options(*command, options->report);
  command->callback([options, &failures] { failures = bench::requests(*options); });
}

void add_diagrams(CLI::App& app) {
  const auto options = std::make_shared<bench::Diagrams>();
  CLI::App* command = app.add_subcommand(
      "diagrams",
      "Tables of branches of equilibria and of Kapitza's stability chart, which diagrams.gp draws");
  command->add_option("--directory", options->directory, "Where the tables go")->capture_default_str();
  command->add_option("--points", options->points, "Of the chart along either axis")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  command->callback([options] { bench::diagrams(*options); });
}

void add_pages(CLI::App& app) {
  const auto options = std::make_shared<bench::Pages>();
  CLI::App* command = app.add_subcommand(
      "pages", "A certified run of each model against its hand derivation, which motion.gp draws");
  command->add_option("--directory", options->directory, "Where the files go")->capture_default_str();
  command->add_option("--model", options->models, "all, or names as in `list`")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--samples", options->samples, "Of each run")
      ->check(CLI::Range(2, 10'000))
      ->capture_default_str();
  command->callback([options] { bench::pages(*options); });
}

/// A program of its own, beside this one.
void add_program(CLI::App& app, const std::string& name, const std::string& program,
                 const std::string& what) {
  CLI::App* command = app.add_subcommand(name, what + "; options as `" + program + " --help` says");
  command->prefix_command();
  command->callback([command, program] {
    const auto directory = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    std::vector<std::string> words = command->remaining();
    words.insert(words.begin(), directory / program);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    execv(arguments[0], arguments.data());
    throw Error(
        words[0] +
        " could not be run; build the target dalembert-benchmarks, without a shared library and where "
        "what it needs is found");
  });
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"Benchmarks of dalembert"};
  app.require_subcommand(1);
  int failures = 0;
  add_list(app);
  add_work_precision(app);
  add_scaling(app);
  add_own_constraint(app);
  add_leave_out(app, failures);
  add_ratios(app);
  add_extremes(app, failures);
  add_audit(app, failures);
  add_modes(app, failures);
  add_events(app, failures);
  add_certificates(app, failures);
  add_requests(app, failures);
  add_diagrams(app);
  add_pages(app);
  // Its solvers are built with constants that vary; and what needs HDF5, oneTBB and MPI.
  add_program(app, "sensitivity", "dalembert-sensitivity",
              "Errors and work of many scenes with each of the solvers' constants halved and doubled");
  add_program(app, "sweep", "dalembert-sweeps",
              "Many scenes over threads and ranks: efficiency, memory, kills, and three pictures' tables");
  CLI11_PARSE(app, argc, argv);
  return failures == 0 ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << "dalembert-bench: " << error.what() << '\n';
  return 2;
}
