#include "dalembert/core/results/trajectory.h"
#include <dalembert/core/results/columns.h>

#include <fstream>
#include <limits>
#include <locale>
#include <sstream>

namespace dalembert {

namespace {

/// A column's name, in quotes where it needs them (RFC 4180).
std::string quoted(const std::string& name) {
  if (name.find_first_of(",\"\n\r") == std::string::npos) return name;
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

/// In one line, as the comment that it stands in must be.
std::string in_one_line(const std::string& text) {
  std::string line;
  for (const char c : text) {
    if (c == '\n')
      line += "\\n";
    else if (c == '\r')
      line += "\\r";
    else
      line += c;
  }
  return line;
}

void write_preamble(std::ostream& out, const Record& record) {
  out << "# dalembert " << DALEMBERT_VERSION << ", scene \"" << in_one_line(record.layout->scene)
      << "\", stepper " << record.stepper << ", tolerance " << record.tolerance << '\n'
      << "# sign convention: M q'' = F + Z, force of constraint Z = +W^T lambda; units: the scene's own\n"
      << "# " << in_one_line(record.statistics.report()) << '\n';
}

}  // namespace

void Record::write_csv(std::ostream& to) const {
  std::ostringstream out;  // a point is a point, whatever the locale and the format of the stream
  out.imbue(std::locale::classic());
  write_preamble(out, *this);
  out.precision(std::numeric_limits<double>::max_digits10);
  const std::vector<Column> all = columns(*this);
  const auto line = [&](const auto& write) {
    for (std::size_t k = 0; k < all.size(); ++k) write(k == 0 ? out : out << ',', all[k]);
    out << '\n';
  };
  line([](std::ostream& into, const Column& column) { into << quoted(column.name); });
  for (std::size_t i = 0; i < times.size(); ++i) {
    const FlatSample now = sample(i);
    line([&now](std::ostream& into, const Column& column) { into << column.read(now); });
    to << out.str();
    out.str({});
  }
  to << out.str();
}

void Record::write_csv(const std::string& path) const {
  std::ofstream file(path);
  write_csv(file);
  file.flush();
  if (!file) {
    throw Error("Cannot write the trajectory to \"" + path +
                "\": check that the folder exists and is writable");
  }
}

}  // namespace dalembert
