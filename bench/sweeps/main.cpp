#include <dalembert/bench/command_line.h>
#include <dalembert/bench/sweeps/table.h>

#include <iostream>

int main(int argc, char** argv) try {
  using namespace dalembert::bench;
  CLI::App app{"Sweeps: many scenes over threads and ranks. Without a command: the table of all cases."};
  app.require_subcommand(0, 1);

  SweepTable options;
  bool quick = false;
  app.add_option("--runs", options.rows, "Pendulums")
      ->check(CLI::Range(1000, 100'000'000))
      ->capture_default_str();
  app.add_option("--rounds", options.rounds, "Of the timed cases, of which medians count")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--kills", options.kills, "In each case that is killed")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--flips", options.flips, "Points of the double pendulum's chart along either axis")
      ->check(CLI::Range(2, 10'000))
      ->capture_default_str();
  app.add_option("--kapitza", options.kapitza, "Points of Kapitza's chart along either axis")
      ->check(CLI::Range(2, 10'000))
      ->capture_default_str();
  app.add_option("--governors", options.governors, "That are made")
      ->check(CLI::Range(100, 100'000'000))
      ->capture_default_str();
  app.add_flag("--quick", quick, "What takes seconds of each");
  app.add_option("--directory", options.directory, "Where the tables of pictures go")
      ->check(CLI::ExistingDirectory)
      ->capture_default_str();
  add_report(app, options.report);

  std::string example, file;
  std::size_t rows = 1000, bad = 0;
  int threads = 1;
  CLI::App* one =
      app.add_subcommand("case", "One sweep: prints run time [s], failed rows, peak memory [MiB]");
  one->add_option("example", example, "pendulums, flips, kapitza, kapitza-boundary or governors")->required();
  one->add_option("--rows", rows, "Or points along either axis")->capture_default_str();
  one->add_option("--threads", threads, "0: a bare loop without a sweep; -1: beside an idle thread")
      ->capture_default_str();
  one->add_option("--bad", bad, "Each so many pendulums fail; 0: none")->capture_default_str();
  one->add_option("--file", file, "The dataset")->required();

  CLI::App* overhead = app.add_subcommand(
      "overhead", "What rows and chunks cost beside the work: alone, and once more by mpirun");
  overhead->add_option("--file", file, "A name for the files that it makes")->required();

  CLI11_PARSE(app, argc, argv);
  if (overhead->parsed()) {
    sweep_overhead(file);
    return 0;
  }
  if (one->parsed()) {
    sweep_case(example, rows, threads, bad, file);
    return 0;
  }
  if (quick) {
    options.rows = 2000, options.rounds = 1, options.kills = 2;
    options.flips = 20, options.kapitza = 12, options.governors = 200;
  }
  return sweep_table(options) == 0 ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << "dalembert-sweeps: " << error.what() << '\n';
  return 2;
}
