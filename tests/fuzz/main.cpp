#include "workers.h"

#include <CLI/CLI.hpp>

#include <cctype>
#include <fstream>
#include <iostream>

namespace {

using dalembert::Stepper;
using namespace dalembert::fuzz;

/// Seeds that once failed: a number at the beginning of a line; other lines are remarks.
std::vector<std::uint64_t> corpus(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path);
  std::vector<std::uint64_t> seeds;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && std::isdigit(static_cast<unsigned char>(line.front())) != 0)
      seeds.push_back(std::stoull(line));
  }
  return seeds;
}

void print(std::uint64_t seed, Stepper stepper) {
  const Verdict v = judge(seed, stepper);
  std::cout << "seed " << seed << ", " << name(stepper) << ": " << v.outcome << ' ' << v.message << '\n'
            << v.log << v.detail << (v.fault.empty() ? "" : "FAULT: " + v.fault + '\n');
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Random scenes: each must be refused with a reason, or run and keep its constraints.");
  std::uint64_t seed = 1, count = 300;
  std::string steppers = "both", file;
  std::vector<std::uint64_t> only;
  bool list = false;
  app.add_option("--scenes", count, "number of scenes")->capture_default_str();
  app.add_option("--seed", seed, "of the first; the next has the next number")->capture_default_str();
  app.add_option("--stepper", steppers)->check(CLI::IsMember({"ida", "erk", "both"}))->capture_default_str();
  app.add_option("--only", only, "write down the scenes of these seeds and what becomes of them");
  app.add_option("--corpus", file, "run the seeds of this file first");
  app.add_flag("--list", list, "a line for every scene");
  CLI11_PARSE(app, argc, argv);

  std::vector<Stepper> chosen;
  if (steppers != "erk") chosen.push_back(Stepper::ida);
  if (steppers != "ida") chosen.push_back(Stepper::erk);
  for (const std::uint64_t s : only) {
    for (const Stepper stepper : chosen) print(s, stepper);
  }
  if (!only.empty()) return 0;

  std::vector<Task> tasks;
  const auto plan = [&](std::uint64_t s) {
    for (const Stepper stepper : chosen) tasks.push_back({s, stepper});
  };
  if (!file.empty()) {
    for (const std::uint64_t s : corpus(file)) plan(s);
  }
  for (std::uint64_t s = seed; s < seed + count; ++s) plan(s);
  return run_all(tasks, list) == 0 ? 0 : 1;
}
