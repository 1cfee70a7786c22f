#include <dalembert/bench/commands.h>
#include <dalembert/bench/table.h>
#include <dalembert/models/catalogue.h>

#include <CLI/CLI.hpp>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <map>
#include <memory>

namespace dalembert::bench {
namespace {

/// An option whose default stands in the help.
template <class T>
CLI::Option* add(CLI::App& command, const std::string& name, T& value, const std::string& help) {
  return command.add_option(name, value, help)->capture_default_str();
}
template <class T>
CLI::Option* add(CLI::App& command, const std::string& name, std::vector<T>& values,
                 const std::string& help) {
  return command.add_option(name, values, help)->delimiter(',')->capture_default_str();
}

void add_models(CLI::App& command, std::vector<std::string>& models) {
  add(command, "--model", models, "all, or names as in `list`");
}

void add_tolerance(CLI::App& command, auto& tolerance) {
  add(command, "--tolerance", tolerance, "Between 1e-13 and 0.1");
}

void add_repeats(CLI::App& command, int& repeats, const std::string& help, int least = 1) {
  add(command, "--repeat", repeats, help)->check(CLI::Range(least, 10'000));
}

template <class Stepping>
void add_steppers(CLI::App& command, std::vector<Stepping>& steppers, const std::vector<Stepping>& known) {
  std::map<std::string, Stepping> by_name;
  std::string names;
  for (const Stepping one : known) {
    by_name.emplace(name(one), one);
    names += (names.empty() ? "" : ", ") + std::string(name(one));
  }
  const std::string all = known.size() == 2 ? "both" : "all";
  const std::string chosen = steppers.size() == known.size() ? all : name(steppers.front());
  command.add_option("--stepper", steppers, names + "; " + chosen + " unless given")
      ->delimiter(',')
      ->transform(CLI::CheckedTransformer(by_name).description("{" + names + "}"));
}
void add_steppers(CLI::App& command, std::vector<Method>& methods) {
  add_steppers(command, methods, all_methods());
}
void add_steppers(CLI::App& command, std::vector<Stepper>& steppers) {
  add_steppers(command, steppers, {Stepper::ida, Stepper::erk});
}

void add_report(CLI::App& command, ReportOptions& options) {
  command.add_option("--csv", options.csv,
                     "Also write the table to this file, and the same for readers beside it as .txt");
  command.add_option("--note", options.note, "A line for the heading, such as the commit");
}

/// Adds a command's options, and what it does once CLI11 has parsed them: `wrong` counts rows.
using Add = std::function<void(CLI::App& command, int& wrong)>;

template <class Options, class Result>
Add running(Result (*run)(const Options&), std::type_identity_t<void (*)(CLI::App&, Options&)> add_options) {
  return [=](CLI::App& command, int& wrong) {
    const auto options = std::make_shared<Options>();
    add_options(command, *options);
    if constexpr (requires { options->report; }) add_report(command, options->report);
    if constexpr (std::is_void_v<Result>) {
      command.callback([=] { run(*options); });
    } else {
      command.callback([=, &wrong] { wrong = run(*options); });
    }
  };
}

/// A program of its own, beside this one, which reads the options.
Add program(const std::string& name) {
  return [name](CLI::App& command, int&) {
    command.prefix_command();
    command.callback([&command, name] {
      std::vector<std::string> words = command.remaining();
      words.insert(words.begin(), std::filesystem::read_symlink("/proc/self/exe").parent_path() / name);
      std::vector<char*> arguments;
      for (std::string& word : words) arguments.push_back(word.data());
      arguments.push_back(nullptr);
      execv(arguments[0], arguments.data());
      throw Error(
          words[0] +
          " could not be run; build the target dalembert-benchmarks, without a shared library and where "
          "what it needs is found");
    });
  };
}

void list() {
  Table table{.columns = {"model", "notes", "reference"}, .rows = {}};
  for (const models::AnyModel& any : models::catalogue())
    std::visit([&](const auto& m) { table.rows.push_back({m.name, m.notes, m.reference}); }, any);
  table.print(std::cout);
}

struct Command {
  const char* name;
  const char* description;
  Add add;
};

const Command commands[] = {
    {"list", "Name, lecture notes' number and reference of every model",
     [](CLI::App& command, int&) { command.callback(list); }},
    {"work-precision",
     "Errors of motion and of forces of constraint against run time, over falling tolerances",
     running(work_precision,
             [](CLI::App& command, WorkPrecisionOptions& o) {
               add_models(command, o.models);
               add_steppers(command, o.steppers);
               add_tolerance(command, o.tolerances);
               add_repeats(command, o.repeats, "Runs of which the median time counts");
               add(command, "--samples", o.samples,
                   "Equally spaced, at which errors are taken; 2, the ends, times the integration alone");
             })},
    {"scaling", "Run time and peak memory against the size of a scene",
     running(scaling,
             [](CLI::App& command, ScalingOptions& o) {
               add(command, "--model", o.model, "chain");
               add(command, "--size", o.sizes,
                   "Beads; up to " + std::to_string(largest_compared) +
                       " the error is that of the last positions, above it is nan")
                   ->check(CLI::Range(1, 100'000'000));
               add_steppers(command, o.steppers);
               add_tolerance(command, o.tolerance);
               add(command, "--t-end", o.t_end, "Length of the run [s]");
             })},
    {"set-up", "What scenes of pendulums, contacts and friction cost at their start, by their number",
     running(set_up,
             [](CLI::App& command, SetUpOptions& o) {
               add(command, "--size", o.sizes, "Number of pendulums, or of blocks")
                   ->check(CLI::Range(1, 1'000'000));
               add_repeats(command, o.repeats, "Runs of which the median time counts");
               add_steppers(command, o.steppers);
             })},
    {"own-constraint", "Run time of a chain whose rods are a user's lambdas against one of Distances",
     running(own_constraint,
             [](CLI::App& command, OwnConstraintOptions& o) {
               add(command, "--size", o.beads, "Beads")->check(CLI::PositiveNumber);
               add_repeats(command, o.repeats, "Pairs of runs of which the median ratio counts");
               add_steppers(command, o.steppers);
             })},
    {"leave-out", "Run time of scenes stated in full against the same motion without what it does not need",
     running(leave_out,
             [](CLI::App& command, LeaveOutOptions& o) {
               add(command, "--size", o.size, "Beads of the chains, and number of islands")
                   ->check(CLI::Range(1, 100'000));
               add_repeats(command, o.repeats, "Pairs of runs of which the median times count");
               add_tolerance(command, o.tolerance);
               add_steppers(command, o.steppers);
             })},
    {"ratios", "Time to reach an error at the end of a run, against code derived by hand and against peers",
     running(ratios,
             [](CLI::App& command, RatiosOptions& o) {
               add(command, "--scene", o.scenes, "all, or some of " + known_scenes());
               add_steppers(command, o.steppers);
               add(command, "--error", o.errors, "Of position, relative to the system's length")
                   ->check(CLI::Range(1e-10, 1e-2));
               add_repeats(command, o.repeats, "Rounds, of which the median time counts");
               add(command, "--limit", o.limit,
                   "A stepper whose run took longer than this [s] is not tried at tighter tolerances")
                   ->check(CLI::PositiveNumber);
             })},
    {"extremes", "Stiff, extreme and hostile scenes: error against its limit, or the refusal that is due",
     running(extremes,
             [](CLI::App& command, ExtremesOptions& o) {
               add(command, "--case", o.cases, "all, or names as in the table");
               command.add_flag("--quick", o.quick, "Only the part of each sweep that takes seconds");
             })},
    {"audit", "Every law of mechanics that a result must obey against its limit, in all models and extremes",
     running(audit,
             [](CLI::App& command, AuditOptions& o) {
               add_tolerance(command, o.tolerances);
               add_repeats(command, o.repeats, "Pairs of runs of which the median cost counts; 0: none", 0);
               command.add_flag("--quick", o.quick, "Of the extremes only the part that takes seconds");
             })},
    {"modes", "Equilibria, forces of constraint there and small motions against closed forms",
     running(modes,
             [](CLI::App& command, ModesOptions& o) {
               add(command, "--size", o.beads, "Beads of the long chain")->check(CLI::Range(300, 1'000'000));
             })},
    {"events", "Times of impacts, of rest and of forces that vanish against closed forms",
     running(events, [](CLI::App&, EventsOptions&) {})},
    {"certificates", "Errors that certify estimates against the true ones, in all models and events",
     running(certificates,
             [](CLI::App& command, CertificatesOptions& o) {
               add_tolerance(command, o.tolerances);
               command.add_flag("--quick", o.quick, "Two tolerances only");
             })},
    {"requests", "Errors of force that simulate_to is asked for, what it gives, and at what cost",
     running(
         requests,
         [](CLI::App& command, RequestsOptions& o) {
           add_models(command, o.models);
           add(command, "--error", o.errors, "Of force, relative to the model's")->check(CLI::PositiveNumber);
           add_repeats(command, o.repeats, "Runs of which the median time counts");
         })},
    {"diagrams", "Tables of branches of equilibria and of Kapitza's stability chart, which diagrams.gp draws",
     running(
         diagrams,
         [](CLI::App& command, DiagramsOptions& o) {
           add(command, "--directory", o.directory, "Where the tables go");
           add(command, "--points", o.points, "Of the chart along either axis")->check(CLI::Range(2, 1000));
         })},
    {"pages", "A certified run of each model against its hand derivation, which motion.gp draws",
     running(pages,
             [](CLI::App& command, PagesOptions& o) {
               add(command, "--directory", o.directory, "Where the files go");
               add_models(command, o.models);
               add(command, "--samples", o.samples, "Of each run")->check(CLI::Range(2, 10'000));
             })},
    // Its solvers are built with constants that vary.
    {"sensitivity",
     "Errors and work of many scenes with each of the solvers' constants halved and doubled; options as "
     "`dalembert-sensitivity --help` says",
     program("dalembert-sensitivity")},
    // It needs HDF5, oneTBB and MPI.
    {"sweep",
     "Many scenes over threads and ranks: efficiency, memory, kills, and three pictures' tables; options as "
     "`dalembert-sweeps --help` says",
     program("dalembert-sweeps")},
};

}  // namespace
}  // namespace dalembert::bench

int main(int argc, char** argv) try {
  CLI::App app{"Benchmarks of dalembert"};
  app.require_subcommand(1);
  int wrong = 0;
  for (const auto& [name, description, add] : dalembert::bench::commands)
    add(*app.add_subcommand(name, description), wrong);
  CLI11_PARSE(app, argc, argv);
  return wrong == 0 ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << "dalembert-bench: " << error.what() << '\n';
  return 2;
}
