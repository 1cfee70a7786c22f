#include "workers.h"

#include <CLI/CLI.hpp>

#include <fstream>
#include <iostream>
#include <sstream>

namespace {

using dalembert::Stepper;
using namespace dalembert::fuzz;

/// Scenes that once failed: the name of a family and a number at the beginning of a line; other lines are
/// remarks.
std::vector<Task> corpus(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path);
  std::vector<Task> scenes;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string family;
    std::uint64_t seed = 0;
    if (!(words >> family >> seed)) continue;
    for (const Family f : families)
      if (family == name(f)) scenes.push_back({seed, Stepper::ida, f});
  }
  return scenes;
}

void print(const Task& task) {
  const Verdict v = judge(task);
  std::cout << name(task.family) << " seed " << task.seed << ", " << name(task.stepper) << ": "
            << v.outcome.name << ' ' << v.outcome.message << '\n'
            << v.log << v.detail << (v.fault.empty() ? "" : "FAULT: " + v.fault + '\n');
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Random scenes: each must be refused with a reason, or run and keep its constraints.");
  std::uint64_t seed = 1, count = 300;
  std::string steppers = "both", family = "all", file, pairs;
  std::vector<std::uint64_t> only;
  int longest = 60;
  bool list = false;
  app.add_option("--scenes", count, "number of scenes")->capture_default_str();
  app.add_option("--seed", seed, "of the first; the next has the next number")->capture_default_str();
  app.add_option("--stepper", steppers)->check(CLI::IsMember({"ida", "erk", "both"}))->capture_default_str();
  app.add_option("--only", only, "write down the scenes of these seeds and what becomes of them");
  app.add_option("--family", family, "of scenes; redundant and kinked ones are run against a twin")
      ->check(CLI::IsMember({"any", "redundant", "kinked", "one-sided", "rough", "products", "all"}))
      ->capture_default_str();
  app.add_option("--corpus", file, "run the scenes of this file first");
  app.add_option("--longest", longest, "a scene that takes more processor time hangs [s]; the slowest take 4")
      ->capture_default_str();
  app.add_option("--pairs", pairs,
                 "write what became of every pair of features of products to this CSV file");
  app.add_flag("--list", list, "a line for every scene");
  CLI11_PARSE(app, argc, argv);

  std::vector<Stepper> chosen;
  if (steppers != "erk") chosen.push_back(Stepper::ida);
  if (steppers != "ida") chosen.push_back(Stepper::erk);
  const bool write_down = !only.empty();
  for (std::uint64_t i = 0; i < count && !write_down; ++i) only.push_back(seed + i);

  std::vector<Task> tasks;
  const auto plan = [&](std::uint64_t s, Family f) {
    for (const Stepper stepper : chosen) tasks.push_back({s, stepper, f});
  };
  if (!file.empty()) {
    for (const Task& scene : corpus(file)) plan(scene.seed, scene.family);
  }
  for (const Family f : families) {
    if (family != "all" && family != name(f)) continue;
    for (const std::uint64_t s : only) plan(s, f);
  }
  if (write_down) {
    for (const Task& task : tasks) print(task);
    return 0;
  }
  return run_all(tasks, longest, list, pairs) == 0 ? 0 : 1;
}
