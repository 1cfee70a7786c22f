#pragma once

#include "verdict.h"

#include <array>
#include <map>
#include <string>

namespace dalembert::fuzz {

/// What became of the scenes that have two features in common, of every pair.
class Pairs {
 public:
  void add(const Verdict& scene);
  /// Columns `feature,with,scenes,right,refused,faults,most refused by`, one line for each pair.
  void write(const std::string& path) const;
  /// How often each refusal was given, by message.
  void report() const;

 private:
  struct Cell {
    long scenes = 0, right = 0, faults = 0;
    std::map<std::string, long> refusals{};
  };
  std::array<std::array<Cell, features.size()>, features.size()> cells_;
  std::map<std::string, long> refusals_;
};

/// A message without names and numbers, to its first remedy: what kind it is of.
[[nodiscard]] std::string kind_of(const std::string& message);

}  // namespace dalembert::fuzz
