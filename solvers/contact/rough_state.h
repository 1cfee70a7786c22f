#pragma once

#include <dalembert/core/scene/system.h>
#include <dalembert/solvers/base/accuracy.h>
#include <dalembert/solvers/base/hidden.h>
#include <dalembert/solvers/manifold/scales.h>

#include <Eigen/Core>

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// A constraint of Coulomb's law in a run: what it is, and what it does.
struct RoughState {
  enum class Mode { absent, sticks, slides };
  /// Of two slip velocities that slide: slow ones leave rest, or come to it in the direction that they have;
  /// so do fast ones that are seen to rest straight ahead.
  enum class Pace { fast, straight, leaves, ends };
  /// The slowness by which it has that direction at any speed.
  static constexpr double only_direction = 1e100;

  std::size_t number, row, rows;  ///< in the layout
  std::size_t pressed_by = 0, pressing_row = 0;
  double mu = 0.0, mu_static = 0.0;
  bool one_sided = false;
  double sign = 1.0;                         ///< of lambda
  double of_lengths = 1.0, of_angles = 0.0;  ///< what its slip gains by a rate of each
  double noise = 0.0;  ///< a force on it, or on what presses on it, that is round-off of springs
  /// Speeds: the scene's, but of a brake's rotor that of its rim; that may be none, and below which a slip in
  /// space is slow.
  double speed = 0.0, still = 0.0, slow = 0.0;
  Mode mode = Mode::absent;
  bool shared = false;  ///< sticks, but others constrain the same slip
  /// It begins to slide with less friction than it stuck with, though others constrain the same slip.
  bool loses_share = false;
  /// It slides since an onset or a start that has not been settled yet, see DryFriction::settle.
  bool begins = false;
  Eigen::VectorXd direction{};
  Pace pace = Pace::fast;
  double blur = 0.0;                      ///< the slowness of `Sliding`
  std::optional<double> turns{};          ///< of a slip that ends: how much later it rests for its turning
  std::optional<double> let_go{};         ///< when it began to slide, its bound reached
  bool at_rest = false, reached = false;  ///< when what happens now began: no slip; |sigma| at its bound

  /// Its law, as the scene states it now.
  void read_law(const System& stated);
  void adopt(const Scales& scales, double tolerance);
  /// Starts to slide from rest, whatever small slip is left.
  void start_sliding(const Eigen::VectorXd& along);
  /// Comes to rest in this direction, however fast it is.
  void end_straight(const Eigen::VectorXd& along);

  /// Its own of one number for each row.
  [[nodiscard]] Eigen::VectorXd part(std::span<const double> all) const;
  /// A slip that is round-off: one that begins with less may have any sign. What reverses its friction so
  /// late errs by at most twice this speed: a part of a step's tolerance.
  [[nodiscard]] double no_slip(double tolerance) const;
  /// How far back along its direction what slides comes before it counts as stopped. What leaves rest has no
  /// slip yet but the errors of its steps; by half of what is slow at most, up to where friction has its
  /// direction at rest, see SlidingFriction.
  [[nodiscard]] double backlash(double tolerance) const {
    return pace == Pace::leaves ? std::min(true_over_estimated * still, 0.5 * slow) : no_slip(tolerance);
  }
  /// Of what slides, whether its slip along its direction falls to 0 where it ends; else its size falls.
  [[nodiscard]] bool ends_along_direction() const { return rows == 1 || pace != Pace::fast; }
  [[nodiscard]] bool is_fast_in_space() const {
    return mode == Mode::slides && rows == 2 && pace == Pace::fast;
  }
};

/// Notes what their slips gain by rates of coordinates, and the round-off of springs on them.
void measure_gradients(std::span<RoughState> all, const System& stated, const Scales& scales,
                       const Instant& at);

}  // namespace dalembert
