#pragma once

#include <dalembert/solvers/base/options.h>

#include <string>
#include <vector>

namespace dalembert::bench {

struct Pages {
  std::string directory = ".";                ///< of the files
  std::vector<std::string> models = {"all"};  ///< names of the catalogue, or "all"
  int samples = 201;
  double tolerance = 1e-8;
  Stepper stepper = Stepper::erk;
};

/// Writes for each model a certified run: NAME.html, the page that plays it, and its comparison with the hand
/// derivation, NAME-motion.csv, with the columns t; positionK.x and positionK.x.reference of each observed
/// point and axis; forceK and forceK.reference; and the largest errors over points and forces, true and
/// estimated, relative to the model's length and force: error_position, estimated_position, error_force,
/// estimated_force (inf where the certificate says nothing).
/// With "all" also a page for each model of events and each scene of the lecture, without a comparison.
/// models.csv lists what was run: model, notes, reference, t_end, stepper, tolerance, outcome.
/// Throws Error if a file cannot be written. A run that is refused is a row of models.csv.
void pages(const Pages& options);

}  // namespace dalembert::bench
