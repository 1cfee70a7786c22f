#include "dalembert/solvers/contact/contact_law.h"

#include <dalembert/solvers/base/numbers.h>
#include <dalembert/solvers/base/step_failure.h>
#include <dalembert/solvers/contact/round_off.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dalembert {

using Eigen::Index;

Eigen::VectorXd units(const Eigen::MatrixXd& S) {
  return S.diagonal().unaryExpr([](double s) { return s > 0.0 ? 1.0 / std::sqrt(s) : 0.0; });
}

void clear_round_off(Eigen::VectorXd& x, const Eigen::VectorXd& unit, double largest) {
  for (Index i = 0; i < x.size(); ++i)
    if (unit[i] > 0.0 && std::abs(x[i]) * unit[i] <= round_off() * largest) x[i] = 0.0;
}

std::vector<std::size_t> those_at(const Coupling::Places& places, const std::vector<std::size_t>& touching) {
  std::vector<std::size_t> its;
  for (const Index k : places) its.push_back(touching[static_cast<std::size_t>(k)]);
  return its;
}

std::vector<char> marks(const std::vector<std::size_t>& which, std::size_t size) {
  std::vector<char> marks(size, 0);
  for (const std::size_t i : which) marks[i] = 1;
  return marks;
}

Eigen::MatrixXd coupled(const Coupling& coupling, const Coupling::Places& places, const Scales& scales,
                        double rounding) {
  Eigen::MatrixXd S = coupling.S(places);
  const double directions = std::max(1.0, rounding / (epsilon * scales.length));
  const Eigen::VectorXd unit = units(S);
  for (Index i = 0; i < S.rows(); ++i)
    for (Index j = 0; j < S.cols(); ++j)
      if (i != j && std::abs(S(i, j)) * unit[i] * unit[j] <= round_off() * directions) S(i, j) = 0.0;
  return S;
}

std::unique_ptr<Coupling> coupling_of(const System& stated, std::span<const ContactState> contacts,
                                      const std::vector<std::size_t>& which, const Instant& at) {
  std::vector<std::size_t> numbers, others;
  for (const std::size_t i : which) numbers.push_back(contacts[i].number);
  const auto among_them = marks(which, contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (!among_them[i]) others.push_back(contacts[i].number);
  return std::make_unique<Coupling>(std::make_shared<const System>(stated.without(others)), numbers, at);
}

void keep_reached(const Coupling& coupling, std::size_t own, const Scales& scales, double rounding,
                  std::vector<std::size_t>& contacts) {
  std::vector<char> reached(contacts.size(), 0);
  std::fill_n(reached.begin(), own, char{1});
  for (const Coupling::Places& island : coupling.islands()) {
    const Eigen::MatrixXd S = coupled(coupling, island, scales, rounding);
    const auto is_reached = [&](Index k) -> char& {
      return reached[static_cast<std::size_t>(island[static_cast<std::size_t>(k)])];
    };
    for (bool more = true; std::exchange(more, false);)
      for (Index k = 0; k < S.rows(); ++k)
        for (Index j = 0; j < S.cols(); ++j)
          if (is_reached(j) && !is_reached(k) && S(k, j) != 0.0) is_reached(k) = more = true;
  }
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    if (reached[k]) kept.push_back(contacts[k]);
  contacts = std::move(kept);
}

void refuse(const System& stated, std::span<const ContactState> contacts,
            const std::vector<std::size_t>& which, double t, const std::string& what) {
  std::string names;
  for (const std::size_t i : which) names += (names.empty() ? "" : ", ") + stated.row_label(contacts[i].row);
  throw StepFailure{names + ": " + what, t};
}

}  // namespace dalembert
