#include <dalembert/bench/processor_time.h>
#include <dalembert/bench/sweeps/table.h>
#include <dalembert/sweep/book.h>
#include <dalembert/sweep/ranks.h>
#include <dalembert/sweep/sweep.h>

#include <chrono>
#include <cstdio>
#include <iostream>

namespace dalembert::bench {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Rows of two results that cost nothing to compute, a chunk of `rows` of them.
Block block_of(const Chunk& chunk) {
  Block block{.rows = {chunk.rows.first, 0},
              .seconds = 1.0};  // a second each, so that chunks stay of one row
  const double values[] = {1.0, 2.0};
  while (block.rows.count < chunk.rows.count) block.add(values, {}, {2, 0});
  return block;
}

/// Takes chunks and hands them in, as a worker does.
void pass(Source& source) {
  while (const auto chunk = source.next(0)) source.enter(*chunk, block_of(*chunk));
}

void print(const char* what, double microseconds) { std::printf("%-58s %8.2f us\n", what, microseconds); }

}  // namespace

/// What the model in docs/sweeps.md is made of. Of one process: a row, a chunk in the book and the journal,
/// and a row in the dataset; by mpirun: a chunk of another rank.
void sweep_overhead(const std::string& file) {
  const double begin = now();
  const auto ranks = join_ranks();
  const double joined = now();
  constexpr std::size_t chunks = 20'000, rows = 1'000'000;
  if (ranks->size() > 1) {
    if (ranks->rank() == 0) {
      Journal journal(file + ".journal", {}, chunks);
      Book book(journal, chunks, ranks->size() - 1);
      const double start = now(), busy = processor_time();
      ranks->serve(book);
      print("the start of MPI, once", 1e6 * (joined - begin));
      print("a chunk of another rank: processor time of the book", 1e6 * (processor_time() - busy) / chunks);
      print("a chunk of another rank: from hand-out to hand-out",
            1e6 * (now() - start) / chunks * (ranks->size() - 1));
      journal.remove();
    } else {
      const auto source = ranks->source();
      pass(*source);
      ranks->leave();
    }
    return;
  }
  {
    Journal journal(file + ".journal", {}, chunks);
    Book book(journal, chunks, 1);
    const double start = processor_time();
    pass(book);
    print("a chunk: book and journal", 1e6 * (processor_time() - start) / chunks);
    journal.remove();
  }
  const RowFunction nothing{{{"a"}, {"b"}},
                            {},
                            [](const Row& row) {
                              return RowResult{{row[0], 0.0}, {}};
                            },
                            "nothing"};
  const double start = now();
  sweep_rows(grid({{"x", "", 0.0, 1.0, rows}}), nothing, {.file = file, .threads = 1, .progress = false});
  print("a row of a sweep: parameters, block, journal, dataset", 1e6 * (now() - start) / rows);
}

}  // namespace dalembert::bench
