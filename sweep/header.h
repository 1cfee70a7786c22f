#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/sweep/sweep.h>

#include <string>
#include <utility>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// What a sweep is, by name: it stands in journal and dataset, and tells the sweep from others.
using Header = std::vector<std::pair<std::string, std::string>>;

[[nodiscard]] Header header_of(const Parameters& parameters, const RowFunction& row,
                               const SweepOptions& options);

/// Its names alone.
[[nodiscard]] const std::vector<std::string>& header_names();

/// The header as bytes: lengths before texts.
[[nodiscard]] std::string packed(const Header& header);
[[nodiscard]] Header unpacked(const std::string& bytes);

/// Throws Error that says what differs, unless the header found in a file is that of this sweep.
void require_same(const std::string& file, const Header& found, const Header& own);

}  // namespace dalembert
