#include "dalembert/bench/command_line.h"

#include <iostream>

namespace dalembert::bench {

void add_models(CLI::App& command, std::vector<std::string>& models) {
  add(command, "--model", models, "all, or names as in `list`");
}

void add_repeats(CLI::App& command, int& repeats, const std::string& help, int least) {
  add(command, "--repeat", repeats, help)->check(CLI::Range(least, 10'000));
}

void add_report(CLI::App& command, ReportOptions& options) {
  command.add_option("--csv", options.csv,
                     "Also write the table to this file, and the same for readers beside it as .txt");
  command.add_option("--note", options.note, "A line for the heading, such as the commit");
}

int run_commands(const char* program, const char* description, std::span<const Command> commands, int argc,
                 char** argv) {
  try {
    CLI::App app{description};
    app.require_subcommand(1);
    int wrong = 0;
    for (const auto& [listed, add] : commands)
      add(*app.add_subcommand(listed.name, listed.description), wrong);
    CLI11_PARSE(app, argc, argv);
    return wrong == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << program << ": " << error.what() << '\n';
    return 2;
  }
}

}  // namespace dalembert::bench
