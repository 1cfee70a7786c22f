#pragma once

#include <dalembert/core/errors.h>
#include <dalembert/core/results/at_all_samples.h>
#include <dalembert/core/results/event.h>
#include <dalembert/core/results/readings.h>
#include <dalembert/core/results/statistics.h>

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <iosfwd>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dalembert {

struct Record;
struct Ledger;

/// A run at all times, by the polynomials of its stepper (dense output).
class DenseOutput {
 public:
  virtual ~DenseOutput() = default;
  /// Appends the samples at these times. Throws InvalidArgument outside the run.
  virtual void read(std::span<const double> times, Record& out) const = 0;
  /// Calls f with the equations as they are read at this time: at a switch, before it.
  virtual void as_read(double /*t*/, const std::function<void()>& f) const { f(); }
};

/// A run as flat arrays: what a stepper fills and a Trajectory reads.
struct Record {
  std::shared_ptr<const Layout> layout;  ///< names and places of the numbers
  /// Where events change the scene: the layouts after it, and the first sample of each.
  struct Later {
    std::size_t first;                     ///< sample
    std::shared_ptr<const Layout> layout;  ///< from there on
  };
  std::vector<Later> later{};                  ///< in the order of time
  std::string stepper;                         ///< its name
  double tolerance = 0.0;                      ///< of the run
  std::vector<double> times;                   ///< of the samples, increasing
  std::vector<double> values;                  ///< per sample: q, v, a, lambda, constraint forces, energy
  std::vector<char> unique;                    ///< per sample and row, see FlatSample; empty if all are
  Statistics statistics;                       ///< of the run
  std::shared_ptr<const DenseOutput> dense;    ///< if the option `dense` asks for it
  std::vector<std::string> event_names{};      ///< of the events that were asked for
  std::vector<EventRecord> events;             ///< in the order of time,
  std::shared_ptr<const Record> at_events;     ///< with a sample of each; null if none were asked for
  std::shared_ptr<const Record> after_events;  ///< and of the state after it,
  std::vector<double> impulses;                ///< with the impulses of all rows; both null or empty if no
                                               ///< constraint changes
  std::shared_ptr<const Ledger> ledger{};      ///< if the option `ledger` asks for it

  /// Samples that are appended from here on are of this layout, which differs in what forces and masses are.
  void use_layout(const std::shared_ptr<const Layout>& layout);
  /// The layout of a sample.
  [[nodiscard]] const std::shared_ptr<const Layout>& layout_of(std::size_t sample) const;

  /// Makes room, so that `append` allocates nothing for this many samples.
  void reserve(std::size_t samples, const FlatSample& like);
  /// Adds a sample.
  void append(const FlatSample& sample);
  /// Removes all samples.
  void clear();
  /// The numbers of a sample.
  [[nodiscard]] FlatSample sample(std::size_t i) const;
  /// Of the event that happened, or of the constraint that it happened to.
  [[nodiscard]] std::string name_of(const EventRecord& its) const;
  /// How many of `values` each sample has.
  [[nodiscard]] std::size_t stride() const;

  /// The whole run as comma-separated values, all digits, behind lines that start with '#' and describe it:
  /// scene, stepper, tolerance, versions, sign convention, statistics. Columns: t;
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
///   for (const Sample<2>& now : run) std::cout << now.time() << ' ' << now.position(bob).x() << '\n';
///   std::cout << run.positions(bob).row(0).maxCoeff();
///
/// Sign convention: the force of constraint is Z = +W^T lambda and stands with the applied forces,
/// M q'' = F + Z.
///
/// Every function of Sample is one of a Trajectory with the number of a sample as its last argument, see
/// Readings; it throws InvalidArgument also if there is no such sample.
template <int D>
class Trajectory : public Readings<D, Trajectory<D>, std::size_t> {
 public:
  /// Goes from sample to sample.
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;  ///< of std::iterator_traits
    using value_type = Sample<D>;                       ///< of std::iterator_traits
    using difference_type = std::ptrdiff_t;             ///< of std::iterator_traits
    using pointer = void;                               ///< of std::iterator_traits
    using reference = Sample<D>;                        ///< of std::iterator_traits

    /// At sample i.
    Iterator(const Record& record, std::size_t i) : record_(&record), i_(i) {}
    /// The sample.
    Sample<D> operator*() const { return {*record_->layout_of(i_), record_->sample(i_)}; }
    /// To the next sample.
    Iterator& operator++() { return ++i_, *this; }
    /// To the next sample.
    Iterator operator++(int) { return {*record_, i_++}; }
    /// Whether both are at the same sample of the same run.
    bool operator==(const Iterator&) const = default;

   private:
    const Record* record_;
    std::size_t i_;
  };

  /// Reads a run; throws nothing.
  explicit Trajectory(std::shared_ptr<const Record> record);
  // These are compiled once, in the library.
  ~Trajectory();
  Trajectory(const Trajectory& other) noexcept;    ///< shares its numbers, also of one that is moved
  Trajectory& operator=(const Trajectory& other);  ///< shares its numbers

  /// Of samples.
  [[nodiscard]] std::size_t size() const { return record_->times.size(); }
  /// Of the samples, increasing [time].
  [[nodiscard]] std::span<const double> times() const& { return record_->times; }
  /// Sample i, counted from 0.
  [[nodiscard]] Sample<D> sample(std::size_t i) const&;
  /// The same run at other times, in any order, from its start to where it ended: no less accurate than at
  /// its samples. Needs the option `dense`. (Many times at once cost less than one after the other.)
  ///
  ///   const auto run = simulate(scene, {.t_end = 10.0, .dense = true});
  ///   run.at({1.234}).position(bob, 0);
  ///
  /// Throws InvalidArgument without that option, and outside the run; EquationFault where an equation goes
  /// wrong or nothing can be read, and where a law is broken (see Options::audit).
  [[nodiscard]] Trajectory at(std::span<const double> times) const;
  /// The same for a list.
  [[nodiscard]] Trajectory at(std::initializer_list<double> times) const {
    return at(std::span(times.begin(), times.size()));
  }
  /// What happened, in the order of time, and the k-th such instant; see Event. `event_sample` throws
  /// InvalidArgument if there are not so many.
  [[nodiscard]] std::span<const EventRecord> events() const& { return record_->events; }
  /// The name of an event that was asked for, or of the constraint that something happened to.
  ///
  ///   for (const EventRecord& its : run.events())
  ///     std::cout << run.name_of(its) << ' ' << name(its.kind) << " at " << its.time << " s\n";
  [[nodiscard]] std::string name_of(const EventRecord& its) const { return record_->name_of(its); }
  /// The state just before.
  [[nodiscard]] Sample<D> event_sample(std::size_t k) const&;
  /// The state that the run goes on with: with other velocities after an impact.
  [[nodiscard]] Sample<D> sample_after(std::size_t k) const&;
  /// The impulse of a constraint at the k-th such instant, like a multiplier [force time]: it is not 0 for
  /// contacts in impact, and for constraints that react to that.
  template <int Rows>
  [[nodiscard]] Multiplier<Rows> impulse(Constraint<Rows> constraint, std::size_t k) const {
    const std::size_t first = of(constraint) - 3 * record_->coordinates;
    require_event(k);
    Vec<Rows> own = Vec<Rows>::Zero();
    if (!record_->impulses.empty())
      own = Vec<Rows>::from(record_->impulses.data() + k * record_->rows + first);
    if constexpr (Rows == 1) {
      return own[0];
    } else {
      return own;
    }
  }
  /// At the first sample.
  [[nodiscard]] Iterator begin() const { return {*record_, 0}; }
  /// Behind the last.
  [[nodiscard]] Iterator end() const { return {*record_, size()}; }
  /// How well the run obeyed the laws of mechanics, see Audit; empty with the option audit = Audited::off.
  [[nodiscard]] const Audit& audit() const& { return record_->statistics.audit; }
  /// Its energies, work and momenta at every sample. Throws InvalidArgument without the option `ledger`.
  [[nodiscard]] const Ledger& ledger() const&;
  /// What the run cost, and how exact it is.
  [[nodiscard]] const Statistics& statistics() const& { return record_->statistics; }
  /// The same.
  [[nodiscard]] Statistics statistics() const&& { return record_->statistics; }
  /// Its flat numbers, for code that knows no dimension.
  [[nodiscard]] std::shared_ptr<const Record> record() const { return record_; }

  /// Of a particle at all times: D rows and a column per sample. Views, valid as long as a copy of this run
  /// lives. NaN where a force of constraint, and so an acceleration, is not determined.
  [[nodiscard]] AtAllSamples<D> positions(Particle<D> particle) const& { return all<D>(of(particle)); }
  /// Likewise, its velocity.
  [[nodiscard]] AtAllSamples<D> velocities(Particle<D> particle) const& {
    return all<D>(of(particle) + record_->coordinates);
  }
  /// Likewise, its acceleration.
  [[nodiscard]] AtAllSamples<D> accelerations(Particle<D> particle) const& {
    return all<D>(of(particle) + 2 * record_->coordinates);
  }
  /// The angle of a rotor and its derivatives, and the multipliers of a constraint, likewise.
  [[nodiscard]] AtAllSamples<1> angles(Rotor rotor) const& { return all<1>(of(rotor)); }
  /// Likewise, its rate.
  [[nodiscard]] AtAllSamples<1> angular_velocities(Rotor rotor) const& {
    return all<1>(of(rotor) + record_->coordinates);
  }
  /// Likewise, its acceleration.
  [[nodiscard]] AtAllSamples<1> angular_accelerations(Rotor rotor) const& {
    return all<1>(of(rotor) + 2 * record_->coordinates);
  }
  /// Of a constraint at all times: a row per equation.
  template <int Rows>
  [[nodiscard]] AtAllSamples<Rows> multipliers(Constraint<Rows> constraint) const& {
    return all<Rows>(of(constraint));
  }
  // No views into a run that is gone when they are looked at: keep the run.
  void times() const&& = delete;
  void audit() const&& = delete;
  void ledger() const&& = delete;
  void sample(std::size_t) const&& = delete;
  void events() const&& = delete;
  void event_sample(std::size_t) const&& = delete;
  void sample_after(std::size_t) const&& = delete;
  void positions(Particle<D>) const&& = delete;
  void velocities(Particle<D>) const&& = delete;
  void accelerations(Particle<D>) const&& = delete;
  void angles(Rotor) const&& = delete;
  void angular_velocities(Rotor) const&& = delete;
  void angular_accelerations(Rotor) const&& = delete;
  template <int Rows>
  void multipliers(Constraint<Rows>) const&& = delete;

  /// See Record.
  void write_csv(std::ostream& out) const { record_->write_csv(out); }
  /// The same into a file; throws Error if it cannot be written.
  void write_csv(const std::string& path) const { record_->write_csv(path); }

 private:
  void require_event(std::size_t k) const;
  /// Where the numbers of something begin in each sample.
  template <class Handle>
  [[nodiscard]] std::size_t of(const Handle& handle) const {
    record_->layout->require(handle);
    if constexpr (requires { handle.coordinate; }) {
      return static_cast<std::size_t>(handle.coordinate);
    } else {
      const auto& its = record_->layout->constraints[static_cast<std::size_t>(handle.index)];
      return 3 * record_->coordinates + static_cast<std::size_t>(its.first_row);
    }
  }
  template <int Rows>
  [[nodiscard]] AtAllSamples<Rows> all(std::size_t first) const {
    return {size() > 0 ? record_->values.data() + first : nullptr, size(), record_->stride()};
  }

  std::shared_ptr<const Record> record_;
};

extern template class Trajectory<2>;
extern template class Trajectory<3>;

template <int D>
Trajectory<D> IntegrationFailure::trajectory() const {
  return Trajectory<D>(record_);
}

}  // namespace dalembert
