#pragma once

#include <dalembert/core/results/event.h>
#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/accuracy.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/contact/change.h>
#include <dalembert/solvers/contact/slip_coupling.h>
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
  /// Throws StepFailure if an impact has loaded any of them.
  void require_no_impulse(std::span<const double> impulses, const Instant& at) const;
  /// The system with what sticks and what slides.
  [[nodiscard]] const std::shared_ptr<const System>& system() const { return system_; }

 private:
  /// What is left until it sticks or slides; the normal force, if that may change its sign; and what is left
  /// until a slip that counts as slow, or as none, no longer does, or until a fast one in space has turned
  /// back.
  enum Watched : std::size_t { mode, sign, speed, kinds };
  enum class Mode { absent, sticks, slides };
  /// Of two slip velocities that slide: slow ones leave rest, or come to it in the direction that they have;
  /// so do fast ones that are seen to rest straight ahead.
  enum class Pace { fast, straight, leaves, ends };
  /// The slowness by which it has that direction at any speed.
  static constexpr double only_direction = 1e100;
  struct Rough {
    std::size_t number, row, rows;  // in the layout
    std::size_t pressed_by = 0, pressing_row = 0;
    double mu = 0.0, mu_static = 0.0;
    bool one_sided = false;
    double sign = 1.0;                         // of lambda
    double of_lengths = 1.0, of_angles = 0.0;  // what its slip gains by a rate of each
    // Speeds: the scene's, but of a brake's rotor that of its rim; that may be none, and below which a slip
    // in space is slow.
    double speed = 0.0, still = 0.0, slow = 0.0;
    Mode mode = Mode::absent;
    bool shared = false;  // sticks, but others constrain the same slip
    Eigen::VectorXd direction{};
    Pace pace = Pace::fast;
    double blur = 0.0;                      // the slowness of `Sliding`
    std::optional<double> turns{};          // of a slip that ends: how much later it rests for its turning
    std::optional<double> let_go{};         // when it began to slide, its bound reached
    bool at_rest = false, reached = false;  // when what happens now began: no slip; |sigma| at its bound

    /// Of what slides, whether its slip along its direction falls to 0 where it ends; else its size falls.
    [[nodiscard]] bool ends_along_direction() const { return rows == 1 || pace != Pace::fast; }
    [[nodiscard]] bool is_fast_in_space() const {
      return mode == Mode::slides && rows == 2 && pace == Pace::fast;
    }
  };
  /// Accelerations and multipliers with the modes as they are.
  struct Motion {
    std::vector<double> a, lambda;
    std::vector<char> unique{};
  };
  /// The switching function that has fallen, if one has.
  using Triggered = std::optional<std::size_t>;

  void read_law(Rough& rough) const;
  void measure_gradients(const Instant& at);
  [[nodiscard]] double round_off_of(const Rough& rough, std::span<const double> a,
                                    std::span<const double> lambda) const;
  [[nodiscard]] static Eigen::VectorXd part(const Rough& rough, std::span<const double> all);
  void find_slip(const Instant& at) const;
  [[nodiscard]] Eigen::VectorXd slip(const Rough& rough) const;
  [[nodiscard]] double no_slip(const Rough& rough) const;
  [[nodiscard]] bool own(const Rough& rough, Triggered triggered, Watched watched) const;
  [[nodiscard]] static bool shared(const Rough& rough, std::span<const char> unique);

  [[nodiscard]] std::shared_ptr<const System> with_modes(const std::vector<std::size_t>& open) const;
  [[nodiscard]] Motion solve(const std::vector<std::size_t>& open, const Instant& at) const;
  [[nodiscard]] std::vector<double> velocities_at_rest(const std::vector<std::size_t>& open,
                                                       const Instant& at) const;
  [[nodiscard]] Eigen::VectorXd slip_acceleration(const Rough& rough, const Instant& at,
                                                  const Motion& motion) const;
  [[nodiscard]] SlipCoupling released(const std::vector<std::size_t>& which,
                                      const std::vector<std::size_t>& open, const Instant& at) const;

  void set_mode_by_slip(Rough& rough, const std::vector<std::size_t>& open, double t, Triggered triggered);
  static void end_straight(Rough& rough, const Eigen::VectorXd& direction);
  [[nodiscard]] double same_time(double t) const;
  void rest_with_others(const std::vector<std::size_t>& open, const Instant& at);
  void find_way_to_rest(Rough& rough, const std::vector<std::size_t>& open, const Instant& at);
  void start_sliding(Rough& rough, const Eigen::VectorXd& direction) const;
  void decide(const std::vector<std::size_t>& open, const Instant& at);
  [[nodiscard]] bool sticks(const Instant& at, const Motion& motion) const;
  void mark_shared(const Motion& motion);
  [[nodiscard]] double excess(const Rough& rough, const Motion& motion) const;
  void require_own_share(const Rough& rough, double t) const;
  [[nodiscard]] bool amend(const Instant& at, const Motion& motion);
  [[nodiscard]] bool release_most_exceeded(const Motion& motion, double t);
  [[nodiscard]] bool turn(Rough& rough, const Instant& at, const Motion& motion) const;
  [[nodiscard]] std::vector<double> modes() const;
  [[nodiscard]] std::vector<EventRecord> changes(const std::vector<Rough>& before, double t,
                                                 Triggered triggered) const;
  [[noreturn]] void refuse(double t) const;

  std::shared_ptr<const System> stated_, system_;
  Scales scales_;
  double tolerance_;
  std::vector<Rough> all_;
  mutable std::vector<double> g_, u_;
  mutable double slip_at_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace dalembert
