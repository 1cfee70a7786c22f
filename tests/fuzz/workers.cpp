#include "workers.h"

#include "pairs.h"

#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <map>
#include <string>
#include <system_error>

namespace dalembert::fuzz {

namespace {

/// Scenes per process: starting one costs as much as a scene.
constexpr std::size_t batch = 100;

/// What a child tells its parent of one task, a line each.
auto told(auto& v) { return std::array{&v.outcome.name, &v.outcome.message, &v.fault, &v.kind, &v.features}; }

void tell(std::FILE* out, const Verdict& v) {
  for (const std::string* text : told(v)) {
    std::string line = *text;
    std::ranges::replace(line, '\n', ' ');
    std::fprintf(out, "%s\n", line.c_str());
  }
  std::fflush(out);
}

/// False at the end.
bool hear(std::FILE* in, Verdict& v) {
  char* text = nullptr;
  std::size_t room = 0;
  bool all = true;
  for (std::string* line : told(v)) {
    const ssize_t length = getline(&text, &room, in);
    all = all && length > 0;
    if (all) line->assign(text, static_cast<std::size_t>(length) - 1);
  }
  std::free(text);
  return all;
}

[[noreturn]] void work(const std::vector<Task>& tasks, std::size_t first, int longest, std::FILE* out) {
  for (std::size_t i = first; i < std::min(first + batch, tasks.size()); ++i) {
    const itimerval limit{{0, 0}, {longest, 0}};
    setitimer(ITIMER_PROF, &limit, nullptr);  // its signal ends the process
    tell(out, judge(tasks[i]));
  }
  const itimerval none{};
  setitimer(ITIMER_PROF, &none, nullptr);
  std::fclose(out);
  std::exit(0);  // and with it the search for leaks
}

std::string ending(int status, int longest) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF) {
    return "hangs: more than " + std::to_string(longest) + " s";
  }
  if (WIFSIGNALED(status)) return std::string("crashed: ") + strsignal(WTERMSIG(status));
  return "ended its process with status " + std::to_string(WEXITSTATUS(status));
}

class Tally {
 public:
  explicit Tally(bool list) : list_(list) {}

  void add(const Task& task, const Verdict& v) {
    if (task.family == Family::products) pairs_.add(v);
    const std::string family = dalembert::fuzz::name(task.family);
    ++outcomes_[(task.family == Family::any ? v.kind : family) + ' ' + v.outcome.name];
    if (!v.fault.empty()) ++faults_;
    if (!list_ && v.fault.empty()) return;
    std::cout << (v.fault.empty() ? "" : "FAULT ") << family << " seed " << task.seed << ' '
              << dalembert::name(task.stepper) << ' ' << v.kind << ' ' << v.outcome.name << ": "
              << (v.fault.empty() ? "" : v.fault + " | ") << v.outcome.message << std::endl;
  }
  int report(const std::string& pairs) const {
    pairs_.report();
    if (!pairs.empty()) pairs_.write(pairs);
    for (const auto& [what, count] : outcomes_) std::cout << count << ' ' << what << '\n';
    std::cout << faults_ << " faults\n";
    return faults_;
  }

 private:
  bool list_;
  int faults_ = 0;
  Pairs pairs_;
  std::map<std::string, int> outcomes_;
};

/// Runs tasks from `first` on in a child until a batch or the child ends; returns where to go on.
std::size_t run_some(const std::vector<Task>& tasks, std::size_t first, int longest, Tally& tally) {
  int ends[2];
  if (pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  std::cout.flush();
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) {
    close(ends[0]);
    work(tasks, first, longest, fdopen(ends[1], "w"));
  }
  close(ends[1]);
  std::FILE* in = fdopen(ends[0], "r");
  std::size_t i = first;
  for (Verdict v; hear(in, v);) tally.add(tasks[i++], v);
  std::fclose(in);
  int status = 0;
  waitpid(child, &status, 0);
  const std::size_t end = std::min(first + batch, tasks.size());
  if (status == 0 && i == end) return end;
  const Task& at_fault = tasks[std::min(i, end - 1)];  // all told: what was found at the end, a leak
  tally.add(at_fault, {.outcome = {"died"}, .fault = ending(status, longest)});
  return std::min(i + 1, end);
}

}  // namespace

int run_all(const std::vector<Task>& tasks, int longest, bool list, const std::string& pairs) {
  Tally tally(list);
  for (std::size_t i = 0; i < tasks.size();) i = run_some(tasks, i, longest, tally);
  return tally.report(pairs);
}

}  // namespace dalembert::fuzz
