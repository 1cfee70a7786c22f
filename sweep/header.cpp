#include "dalembert/sweep/header.h"

#include <dalembert/core/errors.h>
#include <dalembert/sweep/text.h>

#include <cstdint>
#include <cstring>

namespace dalembert {

namespace {

#if defined(__clang__)
constexpr const char* compiler = "clang " __clang_version__;
#else
constexpr const char* compiler = "g++ " __VERSION__;
#endif

void put_text(std::string& bytes, const std::string& text) {
  const std::uint64_t size = text.size();
  bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
  bytes.append(text);
}

std::string take_text(const std::string& bytes, std::size_t& at) {
  std::uint64_t size = 0;
  if (bytes.size() - at < sizeof size) throw Error("journal of a sweep: its header ends too early");
  std::memcpy(&size, bytes.data() + at, sizeof size);
  at += sizeof size;
  if (bytes.size() - at < size) throw Error("journal of a sweep: its header ends too early");
  at += size;
  return bytes.substr(at - size, size);
}

/// The lines in which two texts first differ.
std::pair<std::string, std::string> first_difference(std::string a, std::string b) {
  const auto line = [](const std::string& text) { return text.substr(0, text.find('\n')); };
  while (line(a) == line(b) && a.size() > line(a).size() && b.size() > line(b).size()) {
    a.erase(0, line(a).size() + 1);
    b.erase(0, line(b).size() + 1);
  }
  return {line(a), line(b)};
}

}  // namespace

const std::vector<std::string>& header_names() {
  static const std::vector<std::string> names{"title",  "parameters", "seed",    "results",
                                              "series", "scene",      "library", "compiler"};
  return names;
}

Header header_of(const Parameters& parameters, const RowFunction& row, const SweepOptions& options) {
  const std::string contents[] = {options.title,
                                  as_text(parameters.columns()) + "\n" + parameters.description(),
                                  as_text(parameters.seed()),
                                  as_text(row.quantities),
                                  as_text(row.series),
                                  row.description,
                                  std::string("dalembert ") + DALEMBERT_VERSION,
                                  compiler};
  Header header;
  for (std::size_t i = 0; i < header_names().size(); ++i) header.emplace_back(header_names()[i], contents[i]);
  return header;
}

std::string packed(const Header& header) {
  std::string bytes;
  for (const auto& [name, content] : header) {
    put_text(bytes, name);
    put_text(bytes, content);
  }
  return bytes;
}

Header unpacked(const std::string& bytes) {
  Header header;
  for (std::size_t at = 0; at < bytes.size();) {
    std::string name = take_text(bytes, at);
    header.emplace_back(std::move(name), take_text(bytes, at));
  }
  return header;
}

void require_same(const std::string& file, const Header& found, const Header& own) {
  if (found == own) return;
  std::string what = "its layout";
  for (std::size_t i = 0; i < found.size() && i < own.size(); ++i) {
    if (found[i] == own[i]) continue;
    const auto [there, here] = first_difference(found[i].second, own[i].second);
    what = own[i].first + " \"" + there + "\" there, \"" + here + "\" here";
    break;
  }
  throw Error(file + " holds another sweep: " + what +
              "; give another file, or remove it and its journal to begin anew");
}

}  // namespace dalembert
