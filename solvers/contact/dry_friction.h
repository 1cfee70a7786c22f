#pragma once

#include <dalembert/core/results/event.h>
#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/change.h>
#include <dalembert/solvers/contact/friction_equations.h>
#include <dalembert/solvers/contact/rough_state.h>
#include <dalembert/solvers/manifold/scales.h>

#include <Eigen/Core>

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The constraints of Coulomb's law in a run: which of them stick, which slide, and what happens where that
/// changes. With u the slip velocities, sigma the friction that is the multiplier of u = 0, lambda the normal
/// force,
///
///   sticks:  u = 0,   |sigma| <= mu_static |lambda|
///   slides:  sigma = -mu |lambda| d,   d = u/|u|; from rest d = u'/|u'|                                  (1)
///
/// What moves slides, whatever it did before. What is at rest sticks if all of it can; else Onset tells which
/// of it slides, and where. What sticks begins to slide where |sigma| reaches its bound, in the direction
/// that sigma opposed, and, if other constraints prescribe its slip, where that moves it. What slides comes
/// to rest where u reaches 0, and sticks there or slides on.
class DryFriction {
 public:
  /// Of the constraints that a scene states.
  DryFriction(std::shared_ptr<const System> stated, const Scales& scales, double tolerance,
              const Instant& at);

  [[nodiscard]] bool slides_in_space() const;
  /// Before the step from there is looked at: what slides fast in space has this direction, see `switching`.
  void begin_step(const Instant& at);
  /// Whether a switching function has fallen as what slides fast in space passes rest straight ahead. (Its
  /// friction has reversed in that step, which must be taken once more.)
  [[nodiscard]] bool passes_rest(std::size_t function, const Instant& at) const;
  /// Goes on with these equations, whose parameters may differ.
  void replace_system(std::shared_ptr<const System> stated, const Instant& at);
  void adopt(const Scales& scales);

  [[nodiscard]] bool any() const { return !all_.empty(); }
  /// Switching functions, which fall through 0 where something changes, for each constraint those of
  /// `Watched`.
  [[nodiscard]] std::size_t functions() const { return kinds * all_.size(); }
  [[nodiscard]] std::string label(std::size_t function) const;
  [[nodiscard]] double switching(std::size_t function, const FlatSample& now) const;
  /// The unit of its values: of what slides a speed; 0 for forces.
  [[nodiscard]] double unit(std::size_t function) const;
  /// What its values are larger by than a slip that ends.
  [[nodiscard]] double margin(std::size_t function) const;

  /// Decides what sticks, at a state where constraints with these numbers are open. `triggered` is the
  /// switching function that has fallen. Throws StepFailure, naming the constraints, where nothing satisfies
  /// (1); EquationFault.
  std::vector<EventRecord> find_modes(const std::vector<std::size_t>& open, const Instant& at,
                                      std::optional<std::size_t> triggered = {});
  /// Brings to rest at a start what sticks there though it slips, by less than velocities are known.
  void take_away_slip(const std::vector<std::size_t>& open, const Instant& at, Change& change) const;
  /// Once no contact is left that would pull: throws StepFailure if what starts to slide there has had a
  /// share of a friction that the motion does not determine, or if more than one motion satisfies (1).
  void settle(const std::vector<std::size_t>& open, const Instant& at);
  /// Throws StepFailure if an impact has loaded any of them, by more than speeds are known; if they are all
  /// known, by none.
  void require_no_impulse(std::span<const double> impulses, const Instant& at,
                          std::span<const double> unknown) const;
  /// The system with what sticks and what slides.
  [[nodiscard]] const std::shared_ptr<const System>& system() const { return system_; }

 private:
  /// What is left until it sticks or slides; the normal force, if that may change its sign; and what is left
  /// until a slip that counts as slow, or as none, no longer does, or until a fast one in space has turned
  /// back.
  enum Watched : std::size_t { mode, sign, speed, kinds };
  using Mode = RoughState::Mode;
  using Pace = RoughState::Pace;
  /// The switching function that has fallen, if one has.
  using Triggered = std::optional<std::size_t>;

  [[nodiscard]] const System& stated() const { return *equations_.stated(); }
  void find_slip(const Instant& at) const;
  [[nodiscard]] Eigen::VectorXd slip(const RoughState& rough) const;
  [[nodiscard]] bool own(const RoughState& rough, Triggered triggered, Watched watched) const;
  void set_mode_by_slip(RoughState& rough, const std::vector<std::size_t>& open, double t,
                        Triggered triggered);
  [[nodiscard]] double same_time(double t) const;
  void rest_with_others(const std::vector<std::size_t>& open, const Instant& at);
  void find_way_to_rest(RoughState& rough, const std::vector<std::size_t>& open, const Instant& at);
  [[nodiscard]] std::vector<EventRecord> changes(const std::vector<RoughState>& before, double t,
                                                 Triggered triggered) const;

  FrictionEquations equations_;
  std::shared_ptr<const System> system_;
  std::vector<RoughState> all_;
  mutable std::vector<double> g_, u_;
  mutable double slip_at_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace dalembert
