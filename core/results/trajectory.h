#pragma once

#include <dalembert/core/errors.h>
#include <dalembert/core/results/sample.h>
#include <dalembert/core/results/statistics.h>

#include <iosfwd>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dalembert {

/// A run as flat arrays: what a stepper fills and a Trajectory reads.
struct Record {
  std::shared_ptr<const Layout> layout;
  std::string stepper;
  double tolerance = 0.0;
  std::vector<double> times;
  std::vector<double> values;  ///< per sample: q, v, lambda, constraint forces, energy
  std::vector<char> unique;    ///< per sample and row, see FlatSample; empty if all are
  Statistics statistics;

  /// Makes room, so that `append` allocates nothing for this many samples.
  void reserve(std::size_t samples, const FlatSample& like);
  void append(const FlatSample& sample);
  void clear();
  [[nodiscard]] FlatSample sample(std::size_t i) const;

  /// The whole run as comma-separated values, all digits, behind lines that start with '#' and say
  /// what it is: scene, stepper, tolerance, versions, sign convention, statistics. Columns: t;
  /// position and velocity of each particle, angle and rate of each rotor; multipliers of each
  /// constraint and its force on each particle it acts on, "nan" where the state does not determine it;
  /// energy.
  void write_csv(std::ostream& out) const;
  /// The same into a file; throws Error if it cannot be written.
  void write_csv(const std::string& path) const;

  std::size_t coordinates = 0, rows = 0;  ///< n and m
};

/// The motion and the forces of constraint of a scene at a sequence of times. Copies are cheap and
/// share their numbers.
///
/// Sign convention: the force of constraint is Z = +W^T lambda and stands with the applied forces,
/// M q'' = F + Z.
///
/// Functions of a sample i throw InvalidScene if there is no such sample, and for a handle that is
/// not one of this scene's; UndeterminedForce like those of Sample.
template <int D>
class Trajectory {
 public:
  explicit Trajectory(std::shared_ptr<const Record> record);

  [[nodiscard]] std::size_t size() const { return record_->times.size(); }
  [[nodiscard]] std::span<const double> times() const { return record_->times; }
  [[nodiscard]] Sample<D> sample(std::size_t i) const;
  [[nodiscard]] const Statistics& statistics() const { return record_->statistics; }

  /// See Sample for the meaning of these.
  template <Point P>
  [[nodiscard]] Vec<D> position(const P& point, std::size_t i) const {
    return sample(i).position(point);
  }
  template <Point P>
  [[nodiscard]] Vec<D> velocity(const P& point, std::size_t i) const {
    return sample(i).velocity(point);
  }
  [[nodiscard]] double angle(Rotor rotor, std::size_t i) const { return sample(i).angle(rotor); }
  [[nodiscard]] double angular_velocity(Rotor rotor, std::size_t i) const {
    return sample(i).angular_velocity(rotor);
  }
  template <int Rows>
  [[nodiscard]] double constraint_torque(Constraint<Rows> constraint, Rotor rotor, std::size_t i) const {
    return sample(i).constraint_torque(constraint, rotor);
  }
  template <int Rows>
  [[nodiscard]] Multiplier<Rows> multiplier(Constraint<Rows> constraint, std::size_t i) const {
    return sample(i).multiplier(constraint);
  }
  template <int Rows>
  [[nodiscard]] bool is_determined(Constraint<Rows> constraint, std::size_t i) const {
    return sample(i).is_determined(constraint);
  }
  template <int Rows>
  [[nodiscard]] bool is_unique(Constraint<Rows> constraint, std::size_t i) const {
    return sample(i).is_unique(constraint);
  }
  template <int Rows>
  [[nodiscard]] bool is_unique(Constraint<Rows> constraint, int component, std::size_t i) const {
    return sample(i).is_unique(constraint, component);
  }
  template <int Rows>
  [[nodiscard]] Vec<D> constraint_force(Constraint<Rows> constraint, Particle<D> particle,
                                        std::size_t i) const {
    return sample(i).constraint_force(constraint, particle);
  }
  [[nodiscard]] Vec<D> constraint_force(Particle<D> particle, std::size_t i) const {
    return sample(i).constraint_force(particle);
  }
  [[nodiscard]] double energy(std::size_t i) const { return sample(i).energy(); }

  /// See Record.
  void write_csv(std::ostream& out) const { record_->write_csv(out); }
  void write_csv(const std::string& path) const { record_->write_csv(path); }

 private:
  std::shared_ptr<const Record> record_;
};

extern template class Trajectory<2>;
extern template class Trajectory<3>;

template <int D>
Trajectory<D> IntegrationFailure::trajectory() const {
  return Trajectory<D>(record_);
}

}  // namespace dalembert
