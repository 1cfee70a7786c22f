#pragma once

#include <dalembert/bench/report.h>

#include <string>
#include <vector>

/// What each command of dalembert-checks asks, and what it may be given; as in dalembert/bench/commands.h.
namespace dalembert::bench {

struct ExtremesOptions {
  std::vector<std::string> cases = {"all"};  ///< or names
  bool quick = false;                        ///< only the part of each sweep that takes seconds
  ReportOptions report{};
};

/// How does it behave at the edges: right within a derived limit, or a refusal that says why? A row is right
/// if its error is within its limit, be its outcome "ok" or the refusal that is due there (its error is then
/// how far it is from the time or number that it ought to name).
[[nodiscard]] int extremes(const ExtremesOptions& options);

struct AuditOptions {
  std::vector<double> tolerances = {1e-4, 1e-6, 1e-8, 1e-10};
  int repeats = 5;  ///< pairs of runs, with the audit and without, of which the median ratio of times counts
  bool quick = false;
  ReportOptions report{};
};

/// Do the results of every model and of every extreme scene obey the laws of mechanics, and what does looking
/// cost? A row beyond its limit is wrong.
[[nodiscard]] int audit(const AuditOptions& options);

struct ModesOptions {
  int beads = 10'000;  ///< of the long chain
  ReportOptions report{};
};

/// Are equilibria, forces of constraint there and small motions those of the closed forms?
[[nodiscard]] int modes(const ModesOptions& options);

struct EventsOptions {
  ReportOptions report{};
};

/// Do things happen when the closed forms say? By both steppers at several tolerances.
[[nodiscard]] int events(const EventsOptions& options);

struct CertificatesOptions {
  std::vector<double> tolerances = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10};
  bool quick = false;  ///< two tolerances
  ReportOptions report{};
};

/// How true are the errors that `certify` estimates? Compares them with the true ones of every model that has
/// a reference, by both steppers, and with closed forms of the times of events and impulses. What may be
/// wrong are its claims: the shares of estimates within 0.8 to 1.25 and 0.2 to 5 times the true error, and
/// the cost.
[[nodiscard]] int certificates(const CertificatesOptions& options);

struct RequestsOptions {
  std::vector<std::string> models = {"all"};
  std::vector<double> errors = {1e-3, 1e-6, 1e-9};  ///< of force, relative to the model's
  int repeats = 3;                                  ///< the median of whose times counts
  ReportOptions report{};
};

/// Does `simulate_to` meet a requested error of force, and at what cost, compared with the cheapest single
/// run of either stepper that would have met it? A row is wrong if it errs by more than 1.25 times a
/// request that is said to be met; the heading says how many are not, and how many cost more than 4 times as
/// much.
[[nodiscard]] int requests(const RequestsOptions& options);

struct DiagramsOptions {
  std::string directory = ".";  ///< of the tables
  int points = 60;              ///< of Kapitza's chart along either axis
};

/// Writes what bench/charts/diagrams.gp draws: hoop.csv and governor.csv, the branches of equilibria over the
/// rate of rotation (columns branch, rate, angle_deg, softest); kapitza.csv, the growth of a pendulum upright
/// on a vibrating pivot in a period over amplitude and gravity; kapitza-boundary.csv, where it is exactly 1.
void diagrams(const DiagramsOptions& options);

}  // namespace dalembert::bench
