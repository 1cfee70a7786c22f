#pragma once

#include <dalembert/solvers/base/hidden.h>
#include <dalembert/view/write_html.h>

#include <iosfwd>

namespace DALEMBERT_HIDDEN dalembert {

/// Writes what a page shows of a run as JSON; view/page/README.md says what each member is.
void write_page_data(std::ostream& out, const Record& run, const TwoRuns* certified,
                     const PageOptions& options);

}  // namespace dalembert
