#include "pairs.h"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace dalembert::fuzz {

std::string kind_of(const std::string& message) {
  static const std::regex where("^Scene \"[^\"]*\" stopped at t = [^:]*: "), name(" ?\"[^\"]*\""),
      number("[-+]?[0-9][0-9.]*(e[-+]?[0-9]+)?"), remedy(";.*| \\|.*");
  std::string kind = std::regex_replace(message, where, "");
  kind = std::regex_replace(kind, name, "");
  kind = std::regex_replace(kind, remedy, "");
  return std::regex_replace(kind, number, "#").substr(0, 100);
}

void Pairs::add(const Verdict& scene) {
  std::vector<std::size_t> present;
  std::istringstream words(scene.features);
  for (std::string word; words >> word;) {
    const auto found = std::ranges::find_if(features, [&](Feature f) { return word == name(f); });
    present.push_back(static_cast<std::size_t>(found - features.begin()));
  }
  const bool fault = !scene.fault.empty(), right = !fault && scene.outcome.ok();
  const std::string kind = kind_of(scene.outcome.message);
  if (!right && !fault) ++refusals_[kind];
  for (const std::size_t i : present) {
    for (const std::size_t j : present) {
      Cell& cell = cells_[i][j];
      ++cell.scenes;
      if (right) ++cell.right;
      if (fault) ++cell.faults;
      if (!right && !fault) ++cell.refusals[kind];
    }
  }
}

void Pairs::write(const std::string& path) const {
  std::ofstream out(path);
  out << "feature,with,scenes,right,refused,faults,most refused by\n";
  for (std::size_t i = 0; i < features.size(); ++i) {
    for (std::size_t j = i; j < features.size(); ++j) {
      const Cell& cell = cells_[i][j];
      std::string most;
      long count = 0;
      for (const auto& [kind, n] : cell.refusals)
        if (n > count) most = kind, count = n;
      std::ranges::replace(most, ',', ';');
      out << name(features[i]) << ',' << name(features[j]) << ',' << cell.scenes << ',' << cell.right << ','
          << cell.scenes - cell.right - cell.faults << ',' << cell.faults << ',' << most << '\n';
    }
  }
  if (!out) throw std::runtime_error("cannot write " + path);
}

void Pairs::report() const {
  std::vector<std::pair<long, std::string>> all;
  for (const auto& [kind, n] : refusals_) all.emplace_back(n, kind);
  std::ranges::sort(all, std::greater{});
  for (const auto& [n, kind] : all) std::cout << n << " refused: " << kind << '\n';
}

}  // namespace dalembert::fuzz
