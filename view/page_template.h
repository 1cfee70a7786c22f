#pragma once

#include <dalembert/solvers/base/hidden.h>

#include <span>
#include <string_view>

namespace DALEMBERT_HIDDEN dalembert {

/// The page without a run, view/page/page.html, before the data and behind; in pieces, as compilers limit the
/// length of a string. cmake/embed_page.cmake compiles it in.
[[nodiscard]] std::span<const std::string_view> page_before_data();
[[nodiscard]] std::span<const std::string_view> page_behind_data();

}  // namespace dalembert
