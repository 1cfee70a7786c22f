#include "dalembert/solvers/audit/ledger_keeper.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dalembert {

namespace {

/// Gauss' five points between -1 and 1; the rule on the first, middle and last of them is of order 4.
constexpr std::array<double, 5> nodes{-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                                      0.9061798459386640};
constexpr std::array<double, 5> weights{0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                        0.4786286704993665, 0.2369268850561891};
constexpr double outer = 1.0 / (3.0 * nodes[4] * nodes[4]);
constexpr std::array<double, 5> fewer{outer, 0.0, 2.0 - 2.0 * outer, 0.0, outer};

/// Of Newton's resultants: all that acts on the velocities.
double power(const System& system, const FlatSample& sample) {
  double P = 0.0;
  for (std::size_t i = 0; i < sample.v.size(); ++i) P += system.masses()[i] * sample.a[i] * sample.v[i];
  return P;
}

}  // namespace

LedgerKeeper::LedgerKeeper(std::shared_ptr<const System> stated)
    : stated_(std::move(stated)), on_coordinates_(stated_->coordinates()) {}

/// F . v of every force, Z . v of every constraint.
void LedgerKeeper::find_powers(const FlatSample& sample) {
  const bool first = names_.empty();
  powers_.clear();
  const auto put = [&](const std::string& name, double value) {
    if (first) names_.push_back(name);
    powers_.push_back(value);
  };
  put("constant forces", stated_->forces().constant_power(sample.v));
  stated_->forces().for_each_power({sample.time, sample.q, sample.v}, sample.lambda, put);
  const Layout& layout = *stated_->layout();
  const auto power_of = [&](const Layout::Constraint& c) {
    double P = 0.0;
    for (const std::size_t slot : c.slots())
      P += sample.forces[slot] * sample.v[static_cast<std::size_t>(layout.slot_coordinate[slot])];
    return P;
  };
  double inside = 0.0;
  bool bodies = false;
  for (const Layout::Constraint& c : layout.constraints) {
    bodies = bodies || c.internal;
    if (c.internal) {
      inside += power_of(c);
    } else {
      put(first ? c.label() : std::string(), power_of(c));
    }
  }
  static const std::string of_bodies = "what holds bodies together";
  if (bodies) put(of_bodies, inside);
  work_.resize(powers_.size());
}

/// What is on the coordinates, times a factor.
void LedgerKeeper::add(Wrench& sum, double factor, std::span<const double> q) const {
  const auto dimension = static_cast<std::size_t>(stated_->layout()->dimension);
  for (const auto& particle : stated_->layout()->particles) {
    Ledger::Vector r{}, f{};
    for (std::size_t k = 0; k < dimension; ++k) {
      const auto i = static_cast<std::size_t>(particle.coordinate) + k;
      r[k] = q[i];
      f[k] = factor * on_coordinates_[i];
      sum.force[k] += f[k];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
      sum.moment[k] += r[a] * f[b] - r[b] * f[a];
    }
  }
}

/// What a sample's powers and forces give in a time h.
void LedgerKeeper::add(const FlatSample& sample, double h) {
  find_powers(sample);
  for (std::size_t k = 0; k < powers_.size(); ++k) work_[k] += h * powers_[k];
  const auto& coordinates = stated_->layout()->slot_coordinate;
  std::ranges::fill(on_coordinates_, 0.0);
  for (std::size_t slot = 0; slot < coordinates.size(); ++slot)
    on_coordinates_[static_cast<std::size_t>(coordinates[slot])] += sample.forces[slot];
  add(ground_, h, sample.q);
  for (std::size_t i = 0; i < on_coordinates_.size(); ++i)
    on_coordinates_[i] = stated_->masses()[i] * sample.a[i] - on_coordinates_[i];
  add(applied_, h, sample.q);
}

/// The error of a rule of order 4 is h^5, that of Gauss' h^11: the first one's square over the integral is
/// above the second.
void LedgerKeeper::integrate_to(double time, const Read& read) {
  if (!(time > time_)) return;
  const double from = std::exchange(time_, time), h = 0.5 * (time - from);
  double sum = 0.0, rough = 0.0, size = 0.0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    read(from + h * (1.0 + nodes[k]), [&](const FlatSample& sample) {
      const double P = power(*stated_, sample);
      sum += h * weights[k] * P;
      rough += h * fewer[k] * P;
      size += h * weights[k] * std::abs(P);
      add(sample, h * weights[k]);
    });
  }
  const double difference = std::abs(sum - rough);
  since_.sum += sum;
  since_.error += size > difference ? difference * difference / size : difference;
}

/// Their work is P . W (v- + v+)/2.
void LedgerKeeper::jump(const Jump& jump, std::span<const double> w, double put_in) {
  changes_ += put_in;
  std::ranges::fill(on_coordinates_, 0.0);
  for (std::size_t r = 0; r < stated_->rows(); ++r) {
    if (jump.impulses[r] == 0.0) continue;
    for (const std::size_t k : stated_->row(r))
      on_coordinates_[stated_->w_columns()[k]] += w[k] * jump.impulses[r];
  }
  for (std::size_t i = 0; i < on_coordinates_.size(); ++i)
    impacts_ += 0.5 * on_coordinates_[i] * (jump.v_before[i] + jump.v_after[i]);
  add(ground_, 1.0, jump.q);
  time_ = jump.time;
  since_ = {};
}

void LedgerKeeper::keep(const FlatSample& sample) {
  find_powers(sample);
  const auto put = [](std::vector<Ledger::Account>& accounts, std::size_t k, const std::string& name,
                      double value) {
    if (k == accounts.size()) accounts.push_back({name, {}});
    accounts[k].values.push_back(value);
  };
  for (std::size_t k = 0; k < names_.size(); ++k) put(ledger_.work, k, names_[k], work_[k]);
  put(ledger_.work, names_.size(), "impacts", impacts_);
  put(ledger_.work, names_.size() + 1, "changes of the scene", changes_);
  double elastic = 0.0;
  std::size_t spring = 0;
  for (const Layout::Constraint& c : stated_->layout()->constraints) {
    double own = 0.0;
    bool compliant = false;
    for (const std::size_t r : c.own_rows()) {
      compliant = compliant || stated_->law(r).compliant();
      own += stated_->law(r).energy(sample.lambda[r]);
    }
    if (compliant) put(ledger_.elastic, spring++, c.label(), own);
    elastic += own;
  }
  const double T = stated_->kinetic_energy(sample.v);
  ledger_.kinetic.values.push_back(T);
  ledger_.potential.values.push_back(sample.energy - T - elastic);
  for (std::size_t i = 0; i < on_coordinates_.size(); ++i)
    on_coordinates_[i] = stated_->masses()[i] * sample.v[i];
  Wrench momentum;
  add(momentum, 1.0, sample.q);
  ledger_.momentum.push_back(momentum.force);
  ledger_.angular_momentum.push_back(momentum.moment);
  ledger_.applied_impulse.push_back(applied_.force);
  ledger_.applied_moment.push_back(applied_.moment);
  ledger_.ground_impulse.push_back(ground_.force);
  ledger_.ground_moment.push_back(ground_.moment);
}

}  // namespace dalembert
