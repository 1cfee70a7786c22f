#pragma once

#include <dalembert/view/instants.h>
#include <dalembert/view/json.h>

#include <span>

namespace DALEMBERT_HIDDEN dalembert {

/// What a page lists of a run as text: what happened,
void write_events(Json& json, const Record& run, const TwoRuns* certified, std::span<const Shown> shown);
/// its statistics and audit,
void write_statistics(Json& json, const Statistics& s);
/// and its certificate, if there is one.
void write_certificate(Json& json, const TwoRuns* certified);

}  // namespace dalembert
