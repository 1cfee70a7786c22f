#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/sweep/block.h>
#include <dalembert/sweep/header.h>
#include <dalembert/sweep/journal.h>
#include <dalembert/sweep/sweep.h>

#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// What is to be written: rows that no entry has are marked as not done.
struct Dataset {
  const Header& header;
  const Parameters& parameters;
  const RowFunction& row;
  const Journal& journal;
  std::vector<Journal::Entry> entries;
};

/// Makes the HDF5 file anew, beside it, and puts it in the place of the old one at once: at any moment there
/// is a whole one. The same rows give the same bytes. Memory: that of a block. Throws Error if it cannot be
/// written; the old one is still there then.
void publish(const std::string& path, Dataset dataset);

/// What a dataset says about itself.
struct Published {
  Header header;
  std::uint64_t done = 0, failed = 0;
  bool complete = false;
};
/// Throws Error if the file is no dataset of a sweep.
[[nodiscard]] Published published(const std::string& path);

/// What a dataset has for these quantities of a row; NaN of one that failed. Throws Error.
[[nodiscard]] std::vector<double> published_values(const std::string& path,
                                                   const std::vector<Quantity>& quantities,
                                                   std::uint64_t row);

}  // namespace dalembert
