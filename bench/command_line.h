#pragma once

#include <dalembert/bench/report.h>
#include <dalembert/solvers/base/options.h>

#include <CLI/CLI.hpp>

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

/// The command line of a program of several benchmarks.
namespace dalembert::bench {

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

// What several commands have. An option's default is the value that it finds.
void add_models(CLI::App& command, std::vector<std::string>& models);
void add_tolerance(CLI::App& command, auto& tolerance) {
  add(command, "--tolerance", tolerance, "Between 1e-13 and 0.1");
}
void add_repeats(CLI::App& command, int& repeats, const std::string& help, int least = 1);
void add_report(CLI::App& command, ReportOptions& options);

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

/// A command as the help lists it.
struct Listed {
  const char* name;
  const char* description;
};
struct Command {
  Listed listed;
  Add add;
};

/// Does what the arguments say. Returns the program's status: 0, 1 if rows are wrong, 2 after an error, which
/// it prints.
[[nodiscard]] int run_commands(const char* program, const char* description,
                               std::span<const Command> commands, int argc, char** argv);

}  // namespace dalembert::bench
