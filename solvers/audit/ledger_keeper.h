#pragma once

#include <dalembert/core/results/ledger.h>
#include <dalembert/core/results/sample.h>
#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/audit/impact_laws.h>
#include <dalembert/solvers/base/hidden.h>

#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// Keeps a Ledger: powers and forces of a run, as its samples have them, integrated over its steps by Gauss'
/// rule of five points, whose order 10 is above that of any stepper.
class LedgerKeeper {
 public:
  explicit LedgerKeeper(std::shared_ptr<const System> stated);
  /// Goes on with another system of the same constraints and forces.
  void replace_system(std::shared_ptr<const System> stated) { stated_ = std::move(stated); }

  /// Uses an instant of a part of a step, read from the run, where the equations are as they are read there.
  using Use = std::function<void(const FlatSample&)>;
  using Read = std::function<void(double, const Use&)>;
  void start(double time) { time_ = time; }
  void integrate_to(double time, const Read& read);
  /// The impulses of a jump, by W there, and the kinetic energy that a user's change has put in before.
  void jump(const Jump& jump, std::span<const double> w, double put_in);
  /// One of the samples that are handed out.
  void keep(const FlatSample& sample);

  /// The work on kinetic energy since the last call, and what the rule may err by.
  struct Work {
    double sum = 0.0, error = 0.0;
  };
  [[nodiscard]] Work take() { return std::exchange(since_, {}); }
  [[nodiscard]] const Ledger& ledger() const { return ledger_; }

 private:
  /// A force and its moment about the origin.
  struct Wrench {
    Ledger::Vector force{}, moment{};
  };
  void find_powers(const FlatSample& sample);
  void add(const FlatSample& sample, double h);
  void add(Wrench& sum, double factor, std::span<const double> q) const;

  std::shared_ptr<const System> stated_;
  std::vector<std::string> names_;     // of what works: forces and constraints
  std::vector<double> powers_, work_;  // of them
  double impacts_ = 0.0, changes_ = 0.0;
  std::vector<double> on_coordinates_;  // a force, or a momentum
  Wrench applied_, ground_;
  double time_ = 0.0;
  Work since_;
  Ledger ledger_;
};

}  // namespace dalembert
