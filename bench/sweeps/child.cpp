#include "dalembert/bench/sweeps/child.h"

#include <dalembert/core/errors.h>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

namespace dalembert::bench {

namespace {

#ifdef MPIRUN
constexpr const char* mpirun = MPIRUN;
#else
constexpr const char* mpirun = "";
#endif
#ifdef MIMALLOC
constexpr const char* mimalloc = MIMALLOC;
#else
constexpr const char* mimalloc = "";
#endif

[[noreturn]] void become(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv(arguments[0], arguments.data());
  _exit(127);
}

}  // namespace

bool has_mpirun() { return access(mpirun, X_OK) == 0; }

bool has(Allocator allocator) { return allocator == Allocator::glibc || access(mimalloc, R_OK) == 0; }

Child::Child(const std::vector<std::string>& arguments, int ranks, Errors errors, Allocator allocator) {
  std::vector<std::string> words;
  if (ranks > 0)
    for (const std::string& word :
         {std::string(mpirun), std::string("-n"), std::to_string(ranks), std::string("--oversubscribe")})
      words.push_back(word);
  words.emplace_back("/proc/" + std::to_string(getpid()) + "/exe");
  words.insert(words.end(), arguments.begin(), arguments.end());
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw Error("a process of the benchmark cannot be started");
  pipe_ = ends[0];
  id_ = fork();
  if (id_ < 0) throw Error("a process of the benchmark cannot be started");
  if (id_ > 0) {
    close(ends[1]);
    return;
  }
  setpgid(0, 0);
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);  // in a container there is nobody else
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  setenv("OMPI_MCA_pml", "ob1", 1);  // else OpenMPI looks for fast networks for 0.2 s
  if (allocator == Allocator::mimalloc) setenv("LD_PRELOAD", mimalloc, 1);
  dup2(ends[1], STDOUT_FILENO);
  if (errors == Errors::hidden) dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
  become(std::move(words));
}

Child::~Child() {
  if (pipe_ >= 0) close(pipe_);
  if (id_ > 0) waitpid(id_, nullptr, 0);
}

std::vector<pid_t> Child::children() const {
  const std::string id = std::to_string(id_);
  std::ifstream list("/proc/" + id + "/task/" + id + "/children");
  std::vector<pid_t> all;
  for (pid_t child = 0; list >> child;) all.push_back(child);
  return all;
}

void Child::kill_all() const {
  const std::vector<pid_t> ranks = children();
  kill(id_, SIGKILL);
  for (const pid_t rank : ranks) kill(rank, SIGKILL);
}

void Child::kill_one(std::size_t which) const {
  const std::vector<pid_t> ranks = children();
  kill(ranks.empty() ? id_ : ranks[which % ranks.size()], SIGKILL);
}

bool Child::wait(int patience) {
  pollfd end{pipe_, POLLIN, 0};
  char part[4096];
  for (ssize_t count = 1; count > 0;) {
    if (poll(&end, 1, patience) == 0) kill_all();
    count = read(pipe_, part, sizeof part);
    if (count > 0) output_.append(part, static_cast<std::size_t>(count));
  }
  int status = 0;
  waitpid(id_, &status, 0);
  id_ = 0;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace dalembert::bench
