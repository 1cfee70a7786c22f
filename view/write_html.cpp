#include "dalembert/view/write_html.h"

#include <dalembert/core/errors.h>
#include <dalembert/view/page_data.h>
#include <dalembert/view/page_template.h>

#include <fstream>

namespace dalembert::detail {

namespace {

void require_shown(const Record& run) {
  if (!run.times.empty()) return;
  throw InvalidArgument("write_html(): the run of scene \"" + run.layout->scene +
                        "\" has no samples; ask for some, .samples = 1001 or .times = {..}");
}

}  // namespace

void write_page(const Record& run, const TwoRuns* certified, const std::filesystem::path& path,
                const PageOptions& options) {
  require_shown(run);
  std::ofstream file(path, std::ios::binary);
  const auto write = [&](std::span<const std::string_view> pieces) {
    for (const std::string_view piece : pieces) file << piece;
  };
  write(page_before_data());
  if (file) write_page_data(file, run, certified, options);
  write(page_behind_data());
  file.flush();
  if (!file) {
    throw Error("Cannot write the page of scene \"" + run.layout->scene + "\" to \"" + path.string() +
                "\": check that the folder exists and is writable");
  }
}

}  // namespace dalembert::detail
