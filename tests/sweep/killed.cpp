#include "dalembert/tests/sweep/files.h"
#include "dalembert/tests/sweep/swing.h"
#include <dalembert/sweep/runs.h>
#include <dalembert/sweep/sweep.h>

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace dalembert::killed_sweeps {
namespace {

using namespace testing_sweeps;
using ::testing::HasSubstr;

/// Ten rows whose function is cheap; the row `stops_at` asks for an interrupt, as Ctrl-C does.
SweepSummary ten_rows(const std::string& file, std::uint64_t stops_at = 10) {
  const auto function = [stops_at](const Row& row) {
    if (row.index() == stops_at) std::raise(SIGINT);
    if (row.index() % 4 == 3) throw std::runtime_error("no");
    return RowResult{{1.0 / row["x"]}, {row["x"], -row["x"]}};
  };
  return sweep_rows(grid({{"x", "", 1.0, 2.0, 10}}), {{{"y"}}, {{"z"}}, function, ""},
                    {.file = file, .threads = 1, .progress = false});
}

TEST(InterruptedSweep, FinishesTheRunAndGoesOnToTheSameFile) {
  const Folder folder;
  ten_rows(folder / "whole.h5");
  const SweepSummary first = ten_rows(folder / "a.h5", 5);
  EXPECT_TRUE(first.interrupted);
  EXPECT_EQ(first.done, 6U);
  EXPECT_THAT(first.report(), HasSubstr("the same command goes on"));
  const auto y = read_column(folder / "a.h5", "y");
  EXPECT_EQ(y[0], 1.0);
  EXPECT_TRUE(std::isnan(y[9]));
  const SweepSummary second = ten_rows(folder / "a.h5");
  EXPECT_FALSE(second.interrupted);
  EXPECT_EQ(second.found, 6U);
  EXPECT_EQ(bytes_of(folder / "a.h5"), bytes_of(folder / "whole.h5"));
}

/// A kill leaves the journal at any length; a block that is not whole is done again.
TEST(KilledSweep, GoesOnFromAJournalThatEndsAnywhere) {
  const Folder folder;
  ten_rows(folder / "whole.h5");
  const std::string whole = bytes_of(folder / "whole.h5"), file = folder / "a.h5";
  ten_rows(file, 8);
  const std::string journal = bytes_of(file + ".journal"), dataset = bytes_of(file);
  ASSERT_GT(journal.size(), 500U);
  for (std::size_t size = 0; size <= journal.size(); size += 11) {
    write(file + ".journal", journal.substr(0, size));
    write(file, dataset);
    write(file + ".new", "half a dataset");
    ten_rows(file);
    ASSERT_EQ(bytes_of(file), whole) << size;
    ASSERT_FALSE(std::filesystem::exists(file + ".new"));
  }
}

/// Of a journal with a wrong byte what comes before it is kept, or the sweep says that it is damaged: never
/// another dataset.
TEST(KilledSweep, TakesNothingFromAJournalWhereItIsDamaged) {
  const Folder folder;
  ten_rows(folder / "whole.h5");
  const std::string whole = bytes_of(folder / "whole.h5"), file = folder / "a.h5";
  ten_rows(file, 8);
  const std::string journal = bytes_of(file + ".journal"), dataset = bytes_of(file);
  for (std::size_t at = 0; at < journal.size(); at += 17) {
    std::string damaged = journal;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    write(file + ".journal", damaged);
    write(file, dataset);
    try {
      ten_rows(file);
      ASSERT_EQ(bytes_of(file), whole) << at;
    } catch (const Error&) {
      ASSERT_LT(at, journal.size() / 2) << "in its header only";
    }
  }
}

TEST(KilledSweep, OnlyRemovesTheJournalIfKilledBetweenItsLastTwoSteps) {
  const Folder folder;
  ten_rows(folder / "whole.h5");
  const std::string whole = bytes_of(folder / "whole.h5"), file = folder / "a.h5";
  ten_rows(file, 9);  // the last row: all are done, and the journal is gone
  EXPECT_FALSE(std::filesystem::exists(file + ".journal"));
  ten_rows(folder / "b.h5", 8);
  std::filesystem::copy_file(whole.empty() ? file : folder / "whole.h5", folder / "b.h5",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(ten_rows(folder / "b.h5").done, 10U);
  EXPECT_EQ(bytes_of(folder / "b.h5"), whole);
  EXPECT_FALSE(std::filesystem::exists(folder / "b.h5.journal"));
}

TEST(KilledSweep, SaysThatItsJournalIsMissing) {
  const Folder folder;
  const std::string file = folder / "a.h5";
  ten_rows(file, 5);
  std::filesystem::remove(file + ".journal");
  const std::string before = bytes_of(file);
  try {
    ten_rows(file);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("its journal is missing"));
  }
  EXPECT_EQ(bytes_of(file), before);
}

/// A program that gives other numbers than the one that began.
TEST(KilledSweep, IsNotGoneOnWithByAnotherProgram) {
  const Folder folder;
  const auto run = [&](double factor, std::uint64_t stops_at) {
    const auto function = [=](const Row& row) {
      if (row.index() == stops_at) std::raise(SIGINT);
      return RowResult{{factor * row["x"]}, {}};
    };
    sweep_rows(grid({{"x", "", 1.0, 2.0, 10}}), {{{"y"}}, {}, function, ""},
               {.file = folder / "a.h5", .threads = 1, .progress = false});
  };
  run(1.0, 5);
  try {
    run(1.0 + 1e-15, 10);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("has the program changed since"));
  }
  run(1.0, 10);
}

/// The victim as a process of its own: a command of the shell, in a group of its own.
class Process {
 public:
  explicit Process(const std::string& command) : id_(fork()) {
    if (id_ != 0) return;
    setpgid(0, 0);
    execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  void kill(int signal) const { ::kill(-id_, signal); }
  /// What it returned, or minus its signal.
  [[nodiscard]] int wait() const {
    int status = 0;
    waitpid(id_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  pid_t id_;
};

std::string victim(const std::string& file, int rows, int threads, int bad) {
  return std::string("exec ") + VICTIM + ' ' + file + ' ' + std::to_string(rows) + ' ' +
         std::to_string(threads) + ' ' + std::to_string(bad) + " 2> " + file + ".errors > /dev/null";
}

constexpr int rows = 4000, bad = 40;

TEST(KilledSweep, GoesOnAfterSigkillToTheSameFile) {
  const Folder folder;
  ASSERT_EQ(Process(victim(folder / "whole.h5", rows, 1, bad)).wait(), 0);
  const std::string file = folder / "a.h5";
  int kills = 0;
  for (int after = 1; after < 500; after = 1 + after * 3 / 2) {
    const Process process(victim(file, rows, 1, bad));
    std::this_thread::sleep_for(std::chrono::milliseconds(after));
    process.kill(SIGKILL);
    kills += process.wait() == -SIGKILL;
    if (!std::filesystem::exists(file)) continue;
    EXPECT_EQ(read_column(file, "angle").size(), rows);  // it opens
  }
  EXPECT_GT(kills, 0);
  ASSERT_EQ(Process(victim(file, rows, 1, bad)).wait(), 0);
  EXPECT_EQ(bytes_of(file), bytes_of(folder / "whole.h5"));
}

/// A limit on the size of files is met like the end of a disk. Blocks are 512 bytes.
TEST(SweepOnAFullDisk, SaysSoAndGoesOnLaterWithNothingLost) {
  const Folder folder;
  ASSERT_EQ(Process(victim(folder / "whole.h5", rows, 1, 1)).wait(), 0);
  const std::string file = folder / "a.h5";
  // 8 kB: the dataset has no place from the beginning. 300 kB: it has, but not the messages of 4,000
  // failures, 450 kB of them.
  for (const std::string blocks : {"16", "600"}) {
    ASSERT_EQ(Process("trap '' XFSZ; ulimit -f " + blocks + "; " + victim(file, rows, 1, 1)).wait(), 1)
        << blocks;
    EXPECT_THAT(bytes_of(file + ".errors"),
                testing::AllOf(HasSubstr("cannot be written"), HasSubstr("safe")));
  }
  EXPECT_GT(std::filesystem::file_size(file + ".journal"), 10'000U);
  ASSERT_EQ(Process(victim(file, rows, 1, 1)).wait(), 0);
  EXPECT_EQ(bytes_of(file), bytes_of(folder / "whole.h5"));
}

TEST(Sweep, IsRefusedWhileAnotherProcessIsAtIt) {
  const Folder folder;
  const std::string file = folder / "a.h5";
  const Process process(victim(file, 1'000'000, 1, 0));
  while (!std::filesystem::exists(file)) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(Process(victim(file, 1'000'000, 1, 0)).wait(), 1);
  EXPECT_THAT(bytes_of(file + ".errors"), HasSubstr("another process is at this sweep"));
  process.kill(SIGKILL);
  EXPECT_EQ(process.wait(), -SIGKILL);
}

#ifdef MPIRUN
/// OpenMPI refuses root and more processes than cores unless told; and it leaks, which is not ours to report.
std::string by_mpi(int processes, const std::string& command) {
  return "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
         "OMPI_MCA_rmaps_base_oversubscribe=1 ASAN_OPTIONS=detect_leaks=0; exec " +
         std::string(MPIRUN) + " -n " + std::to_string(processes) + ' ' + command.substr(5);
}

TEST(SweepOfManyProcesses, GivesTheSameFileByteByByte) {
  const Folder folder;
  ASSERT_EQ(Process(victim(folder / "whole.h5", rows, 1, bad)).wait(), 0);
  for (const int processes : {2, 3}) {
    const std::string file = folder / std::to_string(processes);
    const int threads = processes == 2 ? 1 : 0;  // as many as there may be
    ASSERT_EQ(Process(by_mpi(processes, victim(file, rows, threads, bad))).wait(), 0)
        << bytes_of(file + ".errors");
    EXPECT_EQ(bytes_of(file), bytes_of(folder / "whole.h5"));
  }
}

TEST(SweepOfManyProcesses, AllSayWhatTheFirstFound) {
  const Folder folder;
  const std::string file = folder / "a.h5";
  ASSERT_EQ(Process(victim(file, 50, 1, 0)).wait(), 0);
  EXPECT_EQ(Process(by_mpi(2, victim(file, 60, 1, 0))).wait(), 1);
  EXPECT_THAT(bytes_of(file + ".errors"), HasSubstr("another sweep"));
}

TEST(SweepOfManyProcesses, IsKilledAndGoesOnWithAnotherNumberOfThem) {
  const Folder folder;
  ASSERT_EQ(Process(victim(folder / "whole.h5", rows, 1, bad)).wait(), 0);
  const std::string file = folder / "a.h5";
  const Process process(by_mpi(2, victim(file, rows, 1, bad)));
  while (!std::filesystem::exists(file)) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  process.kill(SIGKILL);
  [[maybe_unused]] const int killed = process.wait();
  // mpirun's own children notice its end a little later; until then the journal is theirs.
  int result = 1;
  for (int i = 0; i < 100 && result != 0; ++i) {
    result = Process(victim(file, rows, 1, bad)).wait();
    if (result != 0) {
      ASSERT_THAT(bytes_of(file + ".errors"), HasSubstr("another process"));
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
  EXPECT_EQ(bytes_of(file), bytes_of(folder / "whole.h5"));
}
#endif

}  // namespace
}  // namespace dalembert::killed_sweeps
