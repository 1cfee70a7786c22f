#include <dalembert/core/errors.h>
#include <dalembert/sweep/block.h>
#include <dalembert/sweep/book.h>
#include <dalembert/sweep/columns.h>
#include <dalembert/sweep/dataset.h>
#include <dalembert/sweep/housekeeper.h>
#include <dalembert/sweep/interrupt.h>
#include <dalembert/sweep/progress.h>
#include <dalembert/sweep/ranks.h>
#include <dalembert/sweep/sweep.h>
#include <dalembert/sweep/text.h>
#include <dalembert/sweep/worker.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>
#include <thread>
#include <vector>

namespace dalembert {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string journal_of(const std::string& file) { return file + ".journal"; }

/// Throws InvalidArgument for what makes no sense, in every process alike.
int validated_threads(const Parameters& parameters, const RowFunction& row, const SweepOptions& options) {
  if (options.file.empty()) throw InvalidArgument("option file: a sweep needs the name of its dataset");
  if (!row.function) throw InvalidArgument("sweep: there is no function of a row");
  if (row.quantities.empty() && row.series.empty())
    throw InvalidArgument("sweep: nothing is observed; name at least one quantity");
  auto taken = parameters.columns();
  for (const char* own : {"state", "first_sample", "samples"}) taken.push_back({own});
  require_distinct("sweep", parameters.columns(), {taken.end() - 3, taken.end()});
  require_distinct("sweep", row.quantities, taken);
  require_distinct("series of a sweep", row.series);
  if (options.threads < 0)
    throw InvalidArgument("option threads = " + as_text(options.threads) + ", must be >= 0");
  if (options.threads > most_threads())
    throw InvalidArgument("option threads = " + as_text(options.threads) + ", must be at most " +
                          as_text(most_threads()) +
                          " (1 if the library was built without oneTBB); mpirun starts more processes");
  return options.threads == 0 ? usable_threads() : options.threads;
}

[[noreturn]] void refuse_other_numbers(std::uint64_t row) {
  throw Error("row " + as_text(row) +
              " comes out otherwise than when this sweep was begun: has the program changed since? To begin "
              "anew, remove the dataset and its journal");
}

/// Throws Error if this program gives other numbers for a row than those that are in the journal.
void require_same_numbers(const Journal& journal, const Work& work) {
  if (journal.entries().empty()) return;
  const auto& entry = journal.entries().back();
  Block again;
  work.run(entry.rows.first, again);
  if (!journal.read(entry).starts_with(again.bytes)) refuse_other_numbers(entry.rows.first);
}

/// The same of a dataset that has all.
void require_same_numbers(const std::string& file, const RowFunction& row, std::uint64_t rows,
                          const Work& work) {
  if (rows == 0 || row.quantities.empty()) return;  // of series there are too many
  const std::uint64_t last = rows - 1;
  Block block;
  work.run(last, block);
  BlockRow again;
  BlockReader(block.bytes, {row.quantities.size(), row.series.size()}).next(again);
  const std::vector<double> values = published_values(file, row.quantities, last);
  const bool failed = std::ranges::any_of(values, [](double x) { return std::isnan(x); });
  if (again.failed != failed || (!failed && again.values != values)) refuse_other_numbers(last);
}

/// What the first process tells the others, and they throw or return.
struct Verdict {
  std::string error{};
  SweepSummary summary{};
};

std::string packed(const Verdict& verdict) {
  const SweepSummary& s = verdict.summary;
  std::ostringstream out;
  out << s.rows << ' ' << s.done << ' ' << s.failed << ' ' << s.found << ' ' << s.interrupted << ' '
      << s.ranks << '\n'
      << verdict.error;
  return out.str();
}

Verdict unpacked_verdict(const std::string& text) {
  Verdict verdict;
  SweepSummary& s = verdict.summary;
  std::istringstream(text) >> s.rows >> s.done >> s.failed >> s.found >> s.interrupted >> s.ranks;
  verdict.error = text.substr(text.find('\n') + 1);
  return verdict;
}

/// The first process: files, and the book.
class Office {
 public:
  Office(const Parameters& parameters, const RowFunction& row, const SweepOptions& options,
         const Header& header, const Work& work, int workers)
      : parameters_(parameters), row_(row), options_(options), header_(header) {
    summary_.rows = parameters.rows();
    if (is_complete()) {
      require_same_numbers(options.file, row, summary_.rows, work);
      return;
    }
    journal_.emplace(journal_of(options.file), header, parameters.rows());
    if (was_completed_meanwhile()) return;
    require_same_numbers(*journal_, work);
    book_.emplace(*journal_, parameters.rows(), workers);
    summary_.found = book_->counts().done;
    progress_.emplace(parameters.rows(), summary_.found, options.progress, options.log);
    publish_now();
  }

  [[nodiscard]] Book* book() { return book_ ? &*book_ : nullptr; }

  /// Works and serves until there is no more to do.
  void work_off(const Work& work, Ranks& ranks, int threads) {
    const Housekeeper housekeeper(*book_, *progress_, *journal_, [this] { publish_now(); });
    const std::jthread server([&] { ranks.serve(*book_); });
    dalembert::work_off(work, *book_, threads);
  }

  /// Writes what there is. Throws Error.
  void finish() {
    if (!book_) return;
    const Book::Counts counts = book_->counts();
    summary_.done = counts.done;
    summary_.failed = counts.failed;
    summary_.interrupted = counts.done < summary_.rows && book_->error().empty();
    progress_->log(progress_->line(counts));
    if (!book_->error().empty()) throw Error(book_->error());
    journal_->sync();
    publish_now();
    if (counts.done == summary_.rows) journal_->remove();
  }

  [[nodiscard]] const SweepSummary& summary() const { return summary_; }

 private:
  /// Whether the dataset is there, and all of it.
  bool is_complete() {
    if (!std::filesystem::exists(options_.file)) return false;
    const Published found = published(options_.file);
    require_same(options_.file, found.header, header_);
    const bool journal = std::filesystem::exists(journal_of(options_.file));
    if (!found.complete && !journal)
      throw Error(options_.file +
                  " is not complete, and its journal is missing; put it back, or remove the file to "
                  "begin anew");
    if (journal) return false;  // killed between the last two steps
    summary_.done = summary_.found = found.done;
    summary_.failed = found.failed;
    return true;
  }
  /// By another process, between the look at the dataset and the journal that was then made anew.
  bool was_completed_meanwhile() {
    if (!journal_->entries().empty() || !std::filesystem::exists(options_.file)) return false;
    const Published found = published(options_.file);
    if (!found.complete) return false;
    summary_.done = summary_.found = found.done;
    summary_.failed = found.failed;
    journal_->remove();
    return true;
  }
  void publish_now() { publish(options_.file, {header_, parameters_, row_, *journal_, book_->entries()}); }

  const Parameters& parameters_;
  const RowFunction& row_;
  const SweepOptions& options_;
  const Header& header_;
  SweepSummary summary_;
  std::optional<Journal> journal_;
  std::optional<Book> book_;
  std::optional<Progress> progress_;
};

/// The error of a step in the first process; empty if it has none.
template <class Step>
std::string error_of(const Step& step) {
  try {
    step();
    return {};
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace

SweepSummary sweep_rows(const Parameters& parameters, const RowFunction& row, const SweepOptions& options) {
  const auto start = Clock::now();
  const int threads = validated_threads(parameters, row, options);
  const auto ranks = join_ranks();
  const int workers = ranks->sum(threads);
  const Header header = header_of(parameters, row, options);
  const Work work{parameters, row, {row.quantities.size(), row.series.size()}};
  const Interrupt interrupt;

  // Every process knows what the first found before any begins; and all must be at the same sweep.
  std::optional<Office> office;
  std::string begin;
  if (ranks->rank() == 0)
    begin = error_of([&] { office.emplace(parameters, row, options, header, work, workers); });
  begin = ranks->broadcast(begin);
  if (!begin.empty()) throw Error(begin);
  const bool same = unpacked(ranks->broadcast(packed(header))) == header;
  const bool to_do = ranks->broadcast(office && office->book() != nullptr ? "yes" : "no") == "yes";
  if (ranks->sum(same ? 0 : 1) > 0)
    throw Error("sweep: the processes were not all started with the same parameters and scenes");

  if (to_do && office) {
    office->work_off(work, *ranks, threads);
  } else if (to_do) {
    const auto source = ranks->source();
    work_off(work, *source, threads);
    ranks->leave();
  }

  Verdict verdict;
  if (office) {
    verdict.error = error_of([&] { office->finish(); });
    verdict.summary = office->summary();
    verdict.summary.ranks = ranks->size();
  }
  verdict = unpacked_verdict(ranks->broadcast(packed(verdict)));
  if (!verdict.error.empty()) throw Error(verdict.error);
  SweepSummary summary = verdict.summary;
  summary.seconds = seconds_since(start);
  summary.rank = ranks->rank();
  summary.file = options.file;
  return summary;
}

std::string SweepSummary::report() const {
  std::ostringstream out;
  out << file << ": " << done << " of " << rows << " rows, " << failed << " failed; " << done - found
      << " new in " << seconds << " s";
  if (interrupted) out << "; interrupted: the same command goes on from there";
  return out.str();
}

}  // namespace dalembert
