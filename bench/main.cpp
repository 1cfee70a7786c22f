#include <dalembert/bench/checks/listed.h>
#include <dalembert/bench/commands.h>
#include <dalembert/bench/table.h>
#include <dalembert/models/catalogue.h>

#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <map>
#include <memory>

namespace dalembert::bench {
namespace {

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

/// A program of its own, beside this one, which reads these words and then the options.
Add program(const std::string& name, const std::vector<std::string>& first = {}) {
  return [=](CLI::App& command, int&) {
    command.prefix_command();
    command.set_help_flag();  // it has its own
    command.callback([&command, name, first] {
      std::vector<std::string> words{std::filesystem::read_symlink("/proc/self/exe").parent_path() / name};
      words.insert(words.end(), first.begin(), first.end());
      for (const std::string& option : command.remaining()) words.push_back(option);
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

const Command own[] = {
    {{"list", "Name, lecture notes' number and reference of every model"},
     [](CLI::App& command, int&) { command.callback(list); }},
    {{"work-precision",
      "Errors of motion and of forces of constraint against run time, over falling tolerances"},
     running(work_precision,
             [](CLI::App& command, WorkPrecisionOptions& o) {
               add_models(command, o.models);
               add_steppers(command, o.steppers);
               add_tolerance(command, o.tolerances);
               add_repeats(command, o.repeats, "Runs of which the median time counts");
               add(command, "--samples", o.samples,
                   "Equally spaced, at which errors are taken; 2, the ends, times the integration alone");
             })},
    {{"scaling", "Run time and peak memory against the size of a scene"},
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
    {{"set-up", "What scenes of pendulums, contacts and friction cost at their start, by their number"},
     running(set_up,
             [](CLI::App& command, SetUpOptions& o) {
               add(command, "--size", o.sizes, "Number of pendulums, or of blocks")
                   ->check(CLI::Range(1, 1'000'000));
               add_repeats(command, o.repeats, "Runs of which the median time counts");
               add_steppers(command, o.steppers);
             })},
    {{"own-constraint", "Run time of a chain whose rods are a user's lambdas against one of Distances"},
     running(own_constraint,
             [](CLI::App& command, OwnConstraintOptions& o) {
               add(command, "--size", o.beads, "Beads")->check(CLI::PositiveNumber);
               add_repeats(command, o.repeats, "Pairs of runs of which the median ratio counts");
               add_steppers(command, o.steppers);
             })},
    {{"leave-out", "Run time of scenes stated in full against the same motion without what it does not need"},
     running(leave_out,
             [](CLI::App& command, LeaveOutOptions& o) {
               add(command, "--size", o.size, "Beads of the chains, and number of islands")
                   ->check(CLI::Range(1, 100'000));
               add_repeats(command, o.repeats, "Pairs of runs of which the median times count");
               add_tolerance(command, o.tolerance);
               add_steppers(command, o.steppers);
             })},
    {{"ratios", "Time to reach an error at the end of a run, against code derived by hand and against peers"},
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
    {{"pages", "A certified run of each model against its hand derivation, which motion.gp draws"},
     running(pages,
             [](CLI::App& command, PagesOptions& o) {
               add(command, "--directory", o.directory, "Where the files go");
               add_models(command, o.models);
               add(command, "--samples", o.samples, "Of each run")->check(CLI::Range(2, 10'000));
             })},
};

std::vector<Command> commands() {
  std::vector<Command> all(std::begin(own), std::end(own));
  // Compiled while the others measure.
  for (const Listed& check : listed::of_checks)
    all.push_back({check, program("dalembert-checks", {check.name})});
  // Its solvers are built with constants that vary.
  all.push_back({{"sensitivity",
                  "Errors and work of many scenes with each of the solvers' constants halved and doubled"},
                 program("dalembert-sensitivity")});
  // It needs HDF5, oneTBB and MPI.
  all.push_back(
      {{"sweep", "Many scenes over threads and ranks: efficiency, memory, kills, and three pictures' tables"},
       program("dalembert-sweeps")});
  return all;
}

}  // namespace
}  // namespace dalembert::bench

int main(int argc, char** argv) {
  using namespace dalembert::bench;
  return run_commands("dalembert-bench", "Benchmarks of dalembert", commands(), argc, argv);
}
