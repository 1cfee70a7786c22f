#include <dalembert/core/errors.h>
#include <dalembert/sweep/interrupt.h>
#include <dalembert/sweep/ranks.h>

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace dalembert {

namespace {

/// Kinds of messages, as MPI's tags. Replies to worker w have the tag `first_reply + w`.
enum Tag { asks = 1, enters, stops, leaves, first_reply };

using Seconds = std::chrono::duration<double>;

/// Waiting inside MPI takes a whole processor, so waits are naps between looks. A worker that waits has
/// nothing else to do: its naps are short.
constexpr Seconds nap(1e-4);
/// Processor time of a nap and a look (`dalembert-sweeps overhead`).
constexpr double look = 1.2e-5;

/// Between looks of the first process, whose processor works too. A nap of n costs it look / n of its time,
/// and each of the others about n / chunk of theirs: least in sum where these are equal.
Seconds nap_of_first(double chunk, int others) { return Seconds(std::sqrt(look * chunk / others)); }

/// What a message of results begins with; the bytes of the block follow.
struct Results {
  Chunk chunk;
  Interval rows;
  std::uint64_t failures, samples;
  double seconds;
};

struct Question {
  int worker;
  bool interrupted;
};

/// One thread at a time is in MPI (MPI_THREAD_SERIALIZED): no call of it waits.
class Mpi {
 public:
  explicit Mpi(MPI_Comm communicator) : communicator_(communicator) {}

  void send(const std::string& bytes, int to, int tag) {
    MPI_Request request{};
    {
      const std::scoped_lock lock(mutex_);
      MPI_Isend(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, tag, communicator_, &request);
    }
    for (int done = 0; done == 0;) {
      {
        const std::scoped_lock lock(mutex_);
        MPI_Test(&request, &done, MPI_STATUS_IGNORE);
      }
      if (done == 0) std::this_thread::sleep_for(nap);
    }
  }
  template <class Content>
  void send(const Content& content, int to, int tag) {
    send(std::string(reinterpret_cast<const char*>(&content), sizeof content), to, tag);
  }

  struct Message {
    int from = 0, tag = 0;
    std::string bytes{};
    template <class Content>
    [[nodiscard]] Content as() const {
      Content content;
      std::memcpy(&content, bytes.data(), sizeof content);
      return content;
    }
  };
  /// Whether one was there.
  bool receive(Message& message, int from = MPI_ANY_SOURCE, int tag = MPI_ANY_TAG) {
    const std::scoped_lock lock(mutex_);
    int there = 0, size = 0;
    MPI_Status status{};
    MPI_Iprobe(from, tag, communicator_, &there, &status);
    if (there == 0) return false;
    MPI_Get_count(&status, MPI_BYTE, &size);
    message = {status.MPI_SOURCE, status.MPI_TAG, std::string(static_cast<std::size_t>(size), '\0')};
    MPI_Recv(message.bytes.data(), size, MPI_BYTE, message.from, message.tag, communicator_,
             MPI_STATUS_IGNORE);
    return true;
  }

 private:
  std::mutex mutex_;
  MPI_Comm communicator_;
};

class RemoteBook : public Source {
 public:
  explicit RemoteBook(Mpi& mpi) : mpi_(mpi) {}

  std::optional<Chunk> next(int worker) override {
    mpi_.send(Question{worker, Interrupt::noted()}, 0, asks);
    Mpi::Message reply;
    while (!mpi_.receive(reply, 0, first_reply + worker)) std::this_thread::sleep_for(nap);
    const Chunk chunk = reply.as<Chunk>();
    if (chunk.rows.count == 0) return std::nullopt;
    return chunk;
  }
  void enter(const Chunk& chunk, const Block& block) override {
    const Results results{chunk, block.rows, block.failures, block.samples, block.seconds};
    mpi_.send(std::string(reinterpret_cast<const char*>(&results), sizeof results) + block.bytes, 0, enters);
  }
  void stop(const std::string& error) override { mpi_.send(error, 0, stops); }

 private:
  Mpi& mpi_;
};

class MpiRanks : public Ranks {
 public:
  MpiRanks() : communicator_(own()), mpi_(communicator_) {
    MPI_Comm_rank(communicator_, &rank_);
    MPI_Comm_size(communicator_, &size_);
  }
  ~MpiRanks() override { MPI_Comm_free(&communicator_); }

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int size() const override { return size_; }

  [[nodiscard]] std::string broadcast(std::string text) override {
    auto size = static_cast<int>(text.size());
    MPI_Bcast(&size, 1, MPI_INT, 0, communicator_);
    text.resize(static_cast<std::size_t>(size));
    MPI_Bcast(text.data(), size, MPI_BYTE, 0, communicator_);
    return text;
  }
  [[nodiscard]] int sum(int value) override {
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT, MPI_SUM, communicator_);
    return value;
  }

  void serve(Book& book) override {
    // What follows a message, the next question of a worker above all, comes soon.
    const Seconds longest = nap_of_first(book.chunk_seconds(), size_ - 1);
    Seconds pause = nap;
    std::vector<std::pair<int, int>> waiting;  // ranks and their workers
    for (int left = size_ - 1; left > 0;) {
      Mpi::Message message;
      if (!mpi_.receive(message)) {
        std::erase_if(waiting, [&](const auto& who) { return answer(book, who.first, who.second); });
        std::this_thread::sleep_for(pause);
        pause = std::min(2.0 * pause, std::max(nap, longest));
        continue;
      }
      pause = nap;
      if (message.tag == asks) {
        const auto question = message.as<Question>();
        if (question.interrupted) Interrupt::note();
        if (!answer(book, message.from, question.worker)) waiting.emplace_back(message.from, question.worker);
      } else if (message.tag == enters) {
        const auto results = message.as<Results>();
        book.enter(results.chunk, {results.rows, results.failures, results.samples, results.seconds,
                                   message.bytes.substr(sizeof results)});
      } else if (message.tag == stops) {
        book.stop("rank " + std::to_string(message.from) + ": " + message.bytes);
      } else {
        --left;
      }
    }
  }
  [[nodiscard]] std::unique_ptr<Source> source() override { return std::make_unique<RemoteBook>(mpi_); }
  void leave() override { mpi_.send(std::string(), 0, leaves); }

 private:
  /// Apart from what the program itself sends.
  static MPI_Comm own() {
    MPI_Comm communicator{};
    MPI_Comm_dup(MPI_COMM_WORLD, &communicator);
    return communicator;
  }
  /// Whether there was an answer.
  bool answer(Book& book, int rank, int worker) {
    Chunk chunk;
    if (book.try_next(chunk) == Book::State::wait) return false;
    mpi_.send(chunk, rank, first_reply + worker);  // without rows: the end
    return true;
  }

  MPI_Comm communicator_;
  Mpi mpi_;
  int rank_ = 0, size_ = 1;
};

/// Whether a launcher started this process as one of several: mpirun and prterun, or Slurm's srun. Starting
/// MPI otherwise takes longer than many sweeps.
bool launched() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

void finalize() {
  int done = 0;
  MPI_Finalized(&done);
  if (done == 0) MPI_Finalize();
}

}  // namespace

std::unique_ptr<Ranks> join_ranks() {
  int running = 0, provided = 0;
  MPI_Initialized(&running);
  if (running == 0 && !launched()) return std::make_unique<Ranks>();
  if (running == 0) {
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
    std::atexit(finalize);
  } else {
    MPI_Query_thread(&provided);
  }
  if (provided < MPI_THREAD_SERIALIZED)
    throw Error("sweep: MPI was started without threads; call MPI_Init_thread with MPI_THREAD_SERIALIZED");
  return std::make_unique<MpiRanks>();
}

}  // namespace dalembert
