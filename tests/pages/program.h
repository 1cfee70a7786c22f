#pragma once

#include <string_view>
#include <vector>

namespace pages {

/// A program of a page, and the output that the page shows; empty if it shows none.
struct Program {
  std::string_view name;
  void (*run)();
  std::string_view shown;
};

/// All of them; written by pages.cmake.
const std::vector<Program>& programs();

}  // namespace pages
