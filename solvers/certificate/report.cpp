#include "dalembert/solvers/certificate/report.h"

#include <dalembert/core/places.h>
#include <dalembert/solvers/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <sstream>

namespace dalembert::detail {

namespace {

double norm_of(std::span<const double> x) {
  double square = 0.0;
  for (const double value : x) square += value * value;
  return std::sqrt(square);
}

/// What a run shows of one constraint.
class ForceShown {
 public:
  ForceShown(const Record& run, const Layout::Constraint& constraint) : run_(run), constraint_(constraint) {
    for (std::size_t i = 0; i < run.times.size(); ++i) look(i);
  }

  [[nodiscard]] std::string line(const TwoRuns* certified) const {
    std::ostringstream out;
    out << constraint_.label() << ": ";
    if (largest_) {
      out.precision(10);
      out << "largest " << size_;
      out.precision(3);
      if (certified != nullptr) out << " +- " << error(*certified);
      out.precision(6);
      out << " at t = " << run_.times[*largest_] << ", "
          << (unique_ ? "unique" : "not unique: only together with others is it determined");
    } else {
      out << "no force could be read";
    }
    if (undetermined_ > 0)
      out << "; not determined at " << undetermined_ << " of " << run_.times.size() << " samples";
    out << "; " << constraint_.meaning << '\n';
    return out.str();
  }

 private:
  void look(std::size_t i) {
    const FlatSample now = run_.sample(i);
    const double size = norm_of(constraint_.own_rows().in(now.lambda));
    if (std::isnan(size)) {
      ++undetermined_;
      return;
    }
    if (!now.unique.empty())
      unique_ = unique_ &&
                std::ranges::all_of(constraint_.own_rows().in(now.unique), [](char u) { return u != 0; });
    if (largest_ && size <= size_) return;
    largest_ = i;
    size_ = size;
  }

  [[nodiscard]] double error(const TwoRuns& certified) const {
    const Certainty& its = certified.sample(*largest_);
    if (its.doubt != Doubt::none) return std::numeric_limits<double>::infinity();
    const auto a = constraint_.own_rows().in(run_.sample(*largest_).lambda),
               b = constraint_.own_rows().in(certified.reference()->sample(its.counterpart).lambda);
    std::vector<double> difference(a.size());
    std::ranges::transform(a, b, difference.begin(), [](double x, double y) { return x - y; });
    const double error = certified.error_of_force(norm_of(difference), its);
    if (!certified.vibrates()) return error;
    const std::span<const double> amplitudes(certified.passed_over().lambda);
    return std::max(error, norm_of(constraint_.own_rows().in(amplitudes)));
  }

  const Record& run_;
  const Layout::Constraint& constraint_;
  std::optional<std::size_t> largest_;
  double size_ = 0.0;
  bool unique_ = true;
  std::size_t undetermined_ = 0;
};

}  // namespace

std::string report_of_forces(const Record& run, const TwoRuns* certified) {
  std::string all;
  for (const Layout::Constraint& constraint : run.layout->constraints)
    if (!constraint.internal) all += ForceShown(run, constraint).line(certified);
  return all;
}

}  // namespace dalembert::detail
