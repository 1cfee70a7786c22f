#pragma once

#include <string>
#include <string_view>

namespace pages {

/// Where the output differs from what a page shows, in one sentence; empty if nowhere.
///
/// Words must be equal. A number may differ by two units of the last digit that is shown: the last digits of
/// a run depend on the compiler and on the version of SUNDIALS. Behind "+-" stands the estimate of an error,
/// which varies more: within a factor of three. A line "..." stands for any number of lines.
std::string difference(std::string_view shown, std::string_view printed);

}  // namespace pages
