#include <dalembert/bench/checks/commands.h>
#include <dalembert/bench/median.h>
#include <dalembert/bench/progress.h>
#include <dalembert/models/bouncing_ball.h>
#include <dalembert/models/catalogue.h>
#include <dalembert/models/event_model.h>
#include <dalembert/models/plane_pendulum.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>
#include <limits>
#include <span>
#include <utility>

namespace dalembert::bench {

namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();
/// Errors of single samples below this part of the largest one in a run are about those of the better run.
constexpr double of_the_better = 0.01;

/// True and estimated errors, and what of them may be round-off.
struct Estimate {
  double truth = 0.0, estimated = 0.0, round_off = 0.0;

  [[nodiscard]] bool known() const { return estimated < unknown; }
  [[nodiscard]] double ratio() const { return estimated / truth; }
  /// The largest of each; of an error that is not known nothing.
  void take(const Estimate& other) {
    if (!other.known()) return;
    truth = std::max(truth, other.truth);
    estimated = std::max(estimated, other.estimated);
    round_off = std::max(round_off, other.round_off);
  }
};

/// How many estimates above round-off are how close to the truth.
struct Shares {
  long all = 0, close = 0, near = 0, withheld = 0;

  void count(const Estimate& one) {
    if (!one.known()) {
      ++withheld;
      return;
    }
    if (one.estimated <= one.round_off) return;
    ++all;
    if (one.ratio() >= 0.8 && one.ratio() <= 1.25) ++close;
    if (one.ratio() >= 0.2 && one.ratio() <= 5.0) ++near;
  }
  [[nodiscard]] double part(long of) const { return static_cast<double>(of) / static_cast<double>(all); }
  [[nodiscard]] bool within(double least_close, double least_near) const {
    return part(close) >= least_close && part(near) >= least_near;
  }
  [[nodiscard]] std::string text(const std::string& what) const {
    return what + ": " + scientific(100.0 * part(close)) + " % within 0.8 to 1.25, " +
           scientific(100.0 * part(near)) + " % within 0.2 to 5 of the true error, of " +
           std::to_string(all) + " above round-off; " + std::to_string(withheld) + " not known";
  }
};

struct How {
  std::string model;
  Stepper stepper;
  double tolerance;
};

/// The rows of the table, and what they add up to.
class Certified {
 public:
  Table table{
      .columns = {"model", "stepper", "tolerance", "quantity", "true_error", "estimated_error", "round_off"},
      .rows = {}};
  Shares largest, single, of_events;  // the largest errors of runs, those of all samples, those of events

  void add(const How& how, const std::string& quantity, const Estimate& one) {
    table.rows.push_back({how.model, name(how.stepper), shortest_power(how.tolerance), quantity,
                          scientific(one.truth), scientific(one.estimated), scientific(one.round_off)});
  }
  void add_run(const How& how, const std::string& quantity, const Estimate& one) {
    largest.count(one);
    add(how, quantity, one);
  }
  void add_event(const How& how, const std::string& quantity, const Estimate& one) {
    of_events.count(one);
    add(how, quantity, one);
  }
};

/// The observed quantities of a model: how far they are off, and are said to be.
template <int D>
class ModelErrors {
 public:
  ModelErrors(const models::Model<D>& model, const models::Observed<D>& observed,
              const Certificate<D>& certificate, std::span<const models::Observation<D>> reference,
              Shares& single)
      : model_(model),
        observed_(observed),
        certificate_(certificate),
        reference_(reference),
        single_(single) {}

  [[nodiscard]] Estimate positions() const {
    return largest([](const auto& seen) { return seen.positions.size(); },
                   [](const auto& seen, std::size_t k) { return seen.positions[k]; },
                   [](const auto& a, const auto& b) { return (a - b).norm(); }, model_.length);
  }
  [[nodiscard]] Estimate forces() const {
    return largest([](const auto& seen) { return seen.forces.size(); },
                   [](const auto& seen, std::size_t k) { return seen.forces[k]; },
                   [](double a, double b) { return std::abs(a - b); }, model_.force);
  }

 private:
  [[nodiscard]] Estimate largest(const auto& count, const auto& read, const auto& distance,
                                 double unit) const {
    Estimate most;
    for (std::size_t k = 0; k < count(reference_.front()); ++k) {
      const std::vector<Estimate> all = at_samples(k, read, distance, unit);
      Estimate own;
      for (const Estimate& one : all) own.take(one);
      for (const Estimate& one : all)
        if (!one.known() || std::max(one.truth, one.estimated) > of_the_better * own.truth)
          single_.count(one);
      most.take(own);
    }
    return most;
  }

  [[nodiscard]] std::vector<Estimate> at_samples(std::size_t k, const auto& read, const auto& distance,
                                                 double unit) const {
    std::vector<Estimate> all;
    const auto quantity = [&](const Sample<D>& now) { return read(observed_.observe(now), k); };
    for (std::size_t i = 0; i < certificate_.run().size(); ++i) {
      const double truth = distance(quantity(certificate_.run().sample(i)), read(reference_[i], k)) / unit;
      if (std::isnan(truth)) continue;  // not determined there
      all.push_back(
          {truth, certificate_.error(quantity, i) / unit, certificate_.round_off(quantity, i) / unit});
    }
    return all;
  }

  const models::Model<D>& model_;
  const models::Observed<D>& observed_;
  const Certificate<D>& certificate_;
  std::span<const models::Observation<D>> reference_;
  Shares& single_;
};

template <int D>
void add_model(const models::Model<D>& model, const CertificatesOptions& options, Certified& all) {
  const models::Observed<D> observed = model.scene();
  const auto reference = model.observations(sample_times({.t_end = model.t_end}));
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    for (const double tolerance : options.tolerances) {
      const How how{model.name, stepper, tolerance};
      attempt(model.name, [&] {
        const auto certificate =
            certify(observed.scene, {.t_end = model.t_end, .tolerance = tolerance, .stepper = stepper});
        const ModelErrors<D> errors(model, observed, certificate, reference, all.single);
        if (!certificate.complete()) std::cerr << certificate.statement() << '\n';
        all.add_run(how, "position", errors.positions());
        all.add_run(how, "force", errors.forces());
      });
    }
  }
}

void add_events_of(const models::EventModel& model, Stepper stepper, double tolerance, Certified& all) {
  std::optional<TwoRuns> runs;
  const How how{model.name, stepper, tolerance};
  Estimate most;
  for (const models::Timed& row : model.events({stepper, tolerance, &runs})) {
    const double truth = std::abs(row.time.time - row.reference);
    if (std::isnan(truth)) continue;  // it did not happen: of impacts before rest the last ones
    const std::size_t k = row.time.number;
    const Estimate one{truth, runs->error_of_time(k), runs->round_off_of_time(k)};
    all.add_event(how, row.event, one);
    most.take(one);
  }
  all.add_run(how, "time of events", most);
}

void add_events(const CertificatesOptions& options, Certified& all) {
  for (const models::EventModel& model : models::models_with_events()) {
    for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
      for (const double tolerance : options.tolerances)
        attempt(model.name, [&] { add_events_of(model, stepper, tolerance, all); });
    }
  }
}

/// The impulses m (1 + e) u_k of a bouncing ball.
void add_impulses_by(Stepper stepper, double tolerance, Certified& all) {
  const models::BouncingBall ball{.restitution = 0.8};
  const auto built = ball.scene();
  const double end = 0.5 * (ball.impact_time(9) + ball.impact_time(10));
  const auto certificate = certify(built.scene, {.t_end = end, .tolerance = tolerance, .stepper = stepper});
  const How how{"bouncing-ball-0.8", stepper, tolerance};
  double u = std::sqrt(2.0 * ball.gravity * ball.height);
  Estimate most;
  for (std::size_t k = 0; k < certificate.run().events().size(); ++k) {
    const double due = ball.mass * (1.0 + ball.restitution) * u;
    const Certainty& its = certificate.runs().event(k);
    const double impulse = certificate.run().impulse(built.floor, k);
    const double difference =
        std::abs(impulse - certificate.reference().impulse(built.floor, its.counterpart));
    const Estimate one{std::abs(impulse - due), certificate.impulse_error(built.floor, k),
                       certificate.runs().round_off(difference, std::abs(impulse), its)};
    all.add_event(how, "impulse " + std::to_string(k + 1), one);
    most.take(one);
    u *= ball.restitution;
  }
  all.add_run(how, "impulse", most);
}

void add_impulses(const CertificatesOptions& options, Certified& all) {
  for (const Stepper stepper : {Stepper::ida, Stepper::erk}) {
    for (const double tolerance : options.tolerances)
      attempt("bouncing-ball-0.8", [&] { add_impulses_by(stepper, tolerance, all); });
  }
}

/// Of all threads of this program [s].
double time_of_all_threads() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Processor time of `certify` over that of `simulate`: the median of pairs.
double cost_of_pendulum(Stepper stepper, double tolerance) {
  const auto scene = models::PlanePendulum{}.scene().scene;
  const Options options{.t_end = 10.0, .tolerance = tolerance, .stepper = stepper};
  std::vector<double> ratios;
  for (int i = 0; i < 51; ++i) {
    const double begin = time_of_all_threads();
    (void)simulate(scene, options);
    const double between = time_of_all_threads();
    (void)certify(scene, options);
    ratios.push_back((time_of_all_threads() - between) / (between - begin));
  }
  return median(std::move(ratios));
}

std::string cost_text(Stepper stepper, double cost) {
  return "certify of the plane pendulum by " + std::string(name(stepper)) + " takes " + scientific(cost) +
         " times the processor time of a run";
}

/// Says whether a claim holds, and counts it if not.
int claim(bool holds, const std::string& what) {
  std::cout << (holds ? "" : "NOT MET: ") << what << '\n';
  return holds ? 0 : 1;
}

}  // namespace

int certificates(const CertificatesOptions& asked) {
  require_writable(asked.report);
  CertificatesOptions options = asked;
  if (options.quick) options.tolerances = {1e-5, 1e-8};
  Certified all;
  for (const models::AnyModel& any : models::catalogue())
    std::visit([&](const auto& model) { add_model(model, options, all); }, any);
  add_events(options, all);
  add_impulses(options, all);
  report(
      "Errors that certify estimates against the true ones, relative to the model's length and force; "
      "largest of 101 samples",
      all.table, options.report);
  int failed = claim(all.largest.within(0.95, 0.995), all.largest.text("largest errors of runs"));
  failed += claim(all.single.within(0.95, 0.995),
                  all.single.text("errors of single samples above a hundredth of the largest"));
  std::cout << all.of_events.text("times and impulses of single events") << '\n';
  // By the stepper that is the default.
  const double cost = cost_of_pendulum(Stepper::ida, 1e-8);
  failed += claim(cost <= 2.5, cost_text(Stepper::ida, cost));
  std::cout << cost_text(Stepper::erk, cost_of_pendulum(Stepper::erk, 1e-8)) << '\n';
  return failed;
}

}  // namespace dalembert::bench
