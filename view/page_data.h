#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/view/write_html.h>

#include <iosfwd>

namespace DALEMBERT_HIDDEN dalembert {

/// Writes what a page shows of a run as JSON; view/page/README.md says what each member is.
void write_page_data(std::ostream& out, const Record& run, const TwoRuns* certified,
                     const PageOptions& options);

/// Of a point in a picture D numbers out of an instant.
[[nodiscard]] Sketch::Place place_at(const SketchedPoint& point, const FlatSample& at, int dimension);

}  // namespace dalembert
