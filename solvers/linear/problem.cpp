#include "dalembert/solvers/linear/problem.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace dalembert {

namespace {

/// Those in use, those of NewtonMatrix (7) and of its islands, and others that an OutputProjection tries:
/// four at once, so that twice as many find the last ones still there where rows are exchanged to and fro.
/// Only time depends on it.
constexpr std::size_t most_patterns = 8;

}  // namespace

Problem::Problem(System system) : Problem(std::make_shared<const System>(std::move(system))) {}

Problem::Problem(std::shared_ptr<const System> system) {
  std::vector<std::size_t> coordinates(system->coordinates());
  std::iota(coordinates.begin(), coordinates.end(), std::size_t{0});
  shared_ = std::make_shared<Shared>(Shared{std::move(system), std::move(coordinates)});
}

std::shared_ptr<const SaddlePattern> Problem::pattern(const std::vector<std::size_t>& rows) const {
  return pattern(rows, shared_->coordinates);
}

std::shared_ptr<const SaddlePattern> Problem::pattern(const std::vector<std::size_t>& rows,
                                                      const std::vector<std::size_t>& coordinates) const {
  auto& all = shared_->patterns;
  const auto found = std::ranges::find_if(
      all, [&](const auto& known) { return known->rows() == rows && known->coordinates() == coordinates; });
  if (found != all.end()) {
    std::rotate(found, found + 1, all.end());
    return all.back();
  }
  if (all.size() == most_patterns) all.erase(all.begin());
  return all.emplace_back(std::make_shared<const SaddlePattern>(shared_->system, rows, coordinates));
}

SaddlePattern::Analyses Problem::analyses() const {
  SaddlePattern::Analyses sum;
  for (const auto& pattern : shared_->patterns) {
    const auto own = pattern->analyses();
    sum.ldl += own.ldl;
    sum.klu += own.klu;
  }
  return sum;
}

}  // namespace dalembert
