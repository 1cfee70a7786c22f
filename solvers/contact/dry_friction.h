#pragma once

#include <dalembert/core/results/event.h>
#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/manifold/scales.h>

#include <Eigen/Core>

#include <memory>
#include <optional>
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
/// What sticks begins to slide where |sigma| reaches its bound, in the direction that sigma opposed; what
/// slides comes to rest where u reaches 0, and sticks there or slides back. If several would exceed their
/// bounds they are released one by one, the largest excess first, until all satisfy (1); if none of the
/// combinations tried does, that is an error.
class DryFriction {
 public:
  /// What happened to a constraint, by its number in the layout.
  struct Happening {
    std::size_t constraint;
    Happened what;
    double time;
  };

  /// Of the constraints that a scene states.
  DryFriction(std::shared_ptr<const System> stated, const Scales& scales, double tolerance);

  /// Goes on with these equations, whose parameters may differ.
  void restate(std::shared_ptr<const System> stated);
  void adopt(const Scales& scales);

  [[nodiscard]] bool any() const { return !all_.empty(); }
  /// Switching functions, which fall through 0 where something changes, two for each constraint: what is left
  /// until it sticks or slides, and the normal force, if that may change its sign.
  [[nodiscard]] std::size_t functions() const { return 2 * all_.size(); }
  [[nodiscard]] std::string label(std::size_t function) const;
  [[nodiscard]] double switching(std::size_t function, const FlatSample& now) const;

  /// Decides what sticks, at a state where constraints with these numbers are open. `fallen` is the switching
  /// function that has fallen, in the motion `before`. Throws StepFailure, naming the constraints, where
  /// nothing satisfies (1); EquationFault.
  std::vector<Happening> settle(const std::vector<std::size_t>& open, const Instant& at,
                                std::optional<std::size_t> fallen = {}, const FlatSample& before = {});
  /// Throws StepFailure if an impact has loaded any of them.
  void require_no_impulse(std::span<const double> impulses, double t) const;
  /// The system with what sticks and what slides.
  [[nodiscard]] const std::shared_ptr<const System>& system() const { return system_; }

 private:
  enum class Mode { absent, sticks, slides };
  struct Rough {
    std::size_t number, row, rows;  // in the layout
    std::size_t pressed_by = 0, pressing_row = 0;
    double mu = 0.0, mu_static = 0.0;
    bool one_sided = false;
    double sign = 1.0;  // of lambda
    double rest = 0.0;  // a speed that counts as rest
    Mode mode = Mode::absent;
    bool from_rest = false;
    Eigen::VectorXd direction{};
    double slow = 0.0;
  };
  /// Accelerations and multipliers with the modes as they are.
  struct Motion {
    std::vector<double> a, lambda;
    std::vector<char> unique{};
  };

  void read_law(Rough& rough) const;
  [[nodiscard]] double round_off_of(const Rough& rough, std::span<const double> a,
                                    std::span<const double> lambda) const;
  [[nodiscard]] static Eigen::VectorXd part(const Rough& rough, std::span<const double> all);
  void find_slip(const Instant& at) const;
  [[nodiscard]] Eigen::VectorXd slip(const Rough& rough) const;
  void start_sliding(Rough& rough, const Eigen::VectorXd& held_by) const;
  [[nodiscard]] std::shared_ptr<const System> with_modes(const std::vector<std::size_t>& open) const;
  [[nodiscard]] Motion solve(const std::vector<std::size_t>& open, const Instant& at) const;
  [[nodiscard]] Eigen::VectorXd slip_acceleration(const Rough& rough, const Instant& at,
                                                  const Motion& motion) const;
  [[nodiscard]] double rests_at(const Rough& rough, const Instant& at, std::span<const double> a) const;
  void find_direction(Rough& rough, const std::vector<std::size_t>& open, const Instant& at);
  void begin(Rough& rough, const std::vector<std::size_t>& open, std::optional<std::size_t> fallen,
             const FlatSample& motion);
  void require_own_share(const Rough& rough, std::span<const char> unique, double t) const;
  [[nodiscard]] bool amend(const std::vector<std::size_t>& open, const Instant& at, const Motion& motion);
  [[nodiscard]] std::vector<double> modes() const;
  [[nodiscard]] bool release_most_exceeded(const std::vector<std::size_t>& open, const Instant& at,
                                           const Motion& motion);
  [[nodiscard]] bool turn(Rough& rough, const std::vector<std::size_t>& open, const Instant& at,
                          const Motion& motion);
  [[noreturn]] void refuse(double t) const;

  std::shared_ptr<const System> stated_, system_;
  Scales scales_;
  double tolerance_;
  std::vector<Rough> all_;
  mutable std::vector<double> g_, u_;
  mutable double slip_at_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace dalembert
