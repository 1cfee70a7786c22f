#include "dalembert/solvers/equilibrium/steady_continuation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace dalembert {

SteadyCorrector::SteadyCorrector(std::function<PosedSystem(double)> pose_at, const BranchOptions& options)
    : Corrector(std::move(pose_at), options) {
  const PosedSystem posed = pose(options.from);
  if (!std::isfinite(posed.time)) throw InvalidArgument("Option time of a steady motion must be finite");
  const Start start = consistent_start(
      Problem(posed.system), posed.guess, posed.speeds,
      {.t_end = std::numeric_limits<double>::infinity(), .t_start = posed.time, .assemble = true});
  for (std::size_t i = 0; i < start.q.size(); ++i) scale_.push_back(start.scales.unit(i));
  scales_ = start.scales;
  begin_ = point(0.0, {});
}

Node SteadyCorrector::point(double fraction, std::span<const double> beside) const {
  const PosedSystem posed = pose(value(fraction));
  const std::size_t n = scale_.size();
  if (posed.system->coordinates() != n)
    throw InvalidScene("Branches of scene \"" + posed.system->layout()->scene +
                       "\": for another value of the parameter it has other points");
  const FoundSteady found =
      find_steady(*posed.system, posed.guess, posed.speeds, posed.time, posed.keep, beside, scales_.time);
  const FlatSample at = found.state->sample(0);
  Node node;
  node.x.resize(static_cast<Eigen::Index>(n) + 1);
  for (std::size_t i = 0; i < n; ++i) {
    node.x[static_cast<Eigen::Index>(i)] = at.q[i] / scale_[i];
    node.beside.push_back(at.q[i] - posed.guess[i]);
  }
  for (std::size_t i = 0; i < n; ++i) node.beside.push_back(at.v[i] - posed.speeds[i]);
  node.x[static_cast<Eigen::Index>(n)] = fraction;
  node.lambda.assign(at.lambda.begin(), at.lambda.end());
  node.state = {found.state, {}, found.motion};
  const LinearTerms terms = linear_terms(*posed.system, RotatingFrame(*found.motion), {at.time, at.q, at.v},
                                         at.lambda, scales_.roundings_of_difference(at.q));
  node.vibrations = all_vibrations(*posed.system, terms, *found.motion);
  node.stiffness.least = node.vibrations.empty() ? 0.0 : -node.vibrations.front().s.real();
  return node;
}

std::optional<Node> SteadyCorrector::correct(const Node& guess, const Eigen::VectorXd&) const {
  try {
    return point(guess.fraction(), guess.beside);
  } catch (const Error& error) {
    why_ = error.what();
  }
  return std::nullopt;
}

std::optional<Node> SteadyCorrector::finished(Node guess) const { return correct(guess, {}); }

std::optional<Eigen::VectorXd> SteadyCorrector::tangent(const Node& node) const {
  return Eigen::VectorXd(Eigen::VectorXd::Unit(node.x.size(), node.x.size() - 1));
}

}  // namespace dalembert
