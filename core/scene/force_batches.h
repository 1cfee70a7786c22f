#pragma once

#include <dalembert/core/equations/batch.h>
#include <dalembert/core/forces/sliding_friction.h>
#include <dalembert/core/results/applied_forces.h>
#include <dalembert/core/results/layout.h>
#include <dalembert/core/scene/pattern.h>

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dalembert {

/// What the forces of a scene are made of; Scene::system() fills it in.
struct ForceParts {
  std::vector<double> constant{};  ///< one per coordinate
  /// Shared by all systems of a run, whatever is in force, and with its results, which evaluate forces where
  /// they are read.
  std::vector<std::shared_ptr<const ForceBatch>> batches{};
  std::vector<std::vector<int>> numbers{};  ///< per batch: the scene's number of each element
  std::vector<std::pair<int, std::array<double, 3>>> gravities{};  ///< the scene's number, acceleration
};

/// The applied forces of a scene, in batches of one type: F(t,q,v), and behind it F_f(t,q,v,lambda) of those
/// that read multipliers, called friction. What slides comes last. Functions of an instant throw
/// EquationFault if a force throws or is not finite.
class ForceBatches {
 public:
  ForceBatches() = default;
  /// In Branches the batches have the numbers from `first_batch` on. The places of their blocks are appended
  /// to those of the stiffness.
  ForceBatches(ForceParts parts, std::shared_ptr<const Layout> layout, std::size_t first_batch,
               std::vector<MatrixEntry>& stiffness);
  /// Adds that of constraints that slide, by their numbers in the layout.
  void add_sliding(std::shared_ptr<const SlidingFriction> friction, std::vector<int> constraints,
                   std::vector<MatrixEntry>& stiffness);

  /// Whether any depends on time explicitly.
  [[nodiscard]] bool timed() const;
  /// Whether the force of a constraint that slides is among them.
  [[nodiscard]] bool any_slides() const { return !slides_.empty(); }
  /// Places of the entries of d(F + F_f)/dv; places may repeat, their entries add.
  [[nodiscard]] std::span<const MatrixEntry> damping_pattern() const { return damping_pattern_; }
  /// Places of dF_f/dlambda: a coordinate and a row. Empty if no force reads a multiplier.
  [[nodiscard]] std::span<const MatrixEntry> friction_pattern() const { return friction_pattern_; }
  /// Whether any reads multipliers.
  [[nodiscard]] bool has_friction() const { return !friction_pattern_.empty(); }
  /// The number of them that are of forces that the scene states; the rest is of what slides.
  [[nodiscard]] std::size_t stated_friction_entries() const { return stated_friction_entries_; }

  /// F.
  void evaluate(const Instant& at, std::span<double> F) const;
  /// Adds F_f for the multipliers lambda.
  void add_friction(const Instant& at, std::span<const double> lambda, std::span<double> F) const;
  /// dF_f/dlambda, in the order of its pattern.
  void friction_slope(const Instant& at, std::span<const double> lambda, std::span<double> out) const;
  /// d(F + F_f)/dq and d(F + F_f)/dv, in the order of their patterns.
  void linearise(const Instant& at, std::span<const double> lambda, std::span<double> stiffness,
                 std::span<double> damping) const;
  /// What those that slide exert, as multipliers of their rows and in their slots.
  void exert_sliding(const Instant& at, std::span<double> lambda, std::span<double> slots) const;
  /// Energy of all that have one.
  [[nodiscard]] double energy(const Instant& at) const;
  /// F . v of the constant forces together.
  [[nodiscard]] double constant_power(std::span<const double> v) const;
  /// Calls f with the label and F . v of every other one.
  void for_each_power(const Instant& at, std::span<const double> lambda,
                      const std::function<void(std::string, double)>& f) const;
  /// What each force of the scene is, in the order of Layout::forces.
  [[nodiscard]] AppliedForces applied() const;

  /// The label of the force that an entry of the stiffness, beyond those of the constraints, belongs to.
  [[nodiscard]] std::string owner_of_stiffness(std::size_t entry) const;
  /// The same of an entry of dF_f/dlambda.
  [[nodiscard]] std::string owner_of_friction(std::size_t entry) const;
  /// The number of batches that the scene states; those of what slides come behind.
  [[nodiscard]] std::size_t stated() const { return stated_; }
  /// One of them all.
  [[nodiscard]] const ForceBatch& batch(std::size_t b) const { return *parts_.batches[b]; }
  /// Those that read no multipliers.
  [[nodiscard]] auto plain() const { return std::span(parts_.batches).first(first_friction_); }
  /// Those that do.
  [[nodiscard]] auto friction() const { return std::span(parts_.batches).subspan(first_friction_); }
  /// That of an element of a batch.
  [[nodiscard]] std::string label(std::size_t batch, std::size_t element) const;

 private:
  /// Where a batch's part of each array is, and at which row the multipliers of each element begin, if it
  /// reads any.
  struct Own {
    Places slope, stiffness, damping;
    std::vector<std::size_t> first_row{};
  };
  /// Those that read multipliers behind the others.
  void sort();
  /// Those that have no place yet.
  void place(std::vector<MatrixEntry>& stiffness);
  /// Calls f, which evaluates a batch; what it throws gets the label of the force.
  template <class F>
  void with_label(std::size_t batch, double t, const F& f) const;
  /// On the batches from one to before another.
  template <class F>
  void on(std::size_t from, std::size_t end, const Instant& at, std::span<const double> lambda,
          const F& f) const;
  /// The label of the force that an entry of an array belongs to.
  [[nodiscard]] std::string owner_of(std::size_t entry, Places Own::*array) const;

  ForceParts parts_;
  std::shared_ptr<const Layout> layout_;
  std::size_t first_batch_ = 0;
  std::size_t first_friction_ = 0, stated_ = 0, stated_friction_entries_ = 0;
  std::vector<Own> places_;
  std::vector<MatrixEntry> damping_pattern_, friction_pattern_;
  std::vector<std::shared_ptr<const SlidingFriction>> slides_;
};

}  // namespace dalembert
