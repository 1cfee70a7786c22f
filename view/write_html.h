#pragma once

#include <dalembert/solvers/certificate/certificate.h>

#include <cstddef>
#include <filesystem>
#include <string>

namespace dalembert {

/// How a page of a run is written.
struct PageOptions {
  std::string title{};  ///< the scene's name if it is empty
  /// The user's own units, shown behind numbers: {"m", "s", "N"}. Empty ones are not shown.
  struct Units {
    std::string length{};  ///< such as m
    std::string time{};    ///< such as s
    std::string force{};   ///< such as N
  };
  Units units{};  ///< none unless given
  /// A page beyond this many bytes keeps 7 digits of each number in place of 16, and if that does not do,
  /// every second, third, ... sample. It says so.
  std::size_t most_bytes = 20'000'000;
};

namespace detail {
void write_page(const Record& run, const TwoRuns* certified, const std::filesystem::path& path,
                const PageOptions& options);
}

/// Writes a page that plays a run: one file that a browser opens without a network. It shows what the scene
/// states, with the forces of constraint as arrows, plots of all quantities, events, statistics, audit and,
/// if they were asked for, ledger and errors.
///
///   const Certificate<2> certificate = certify(scene, {.t_end = 10.0, .samples = 1001});
///   write_html(certificate, "pendulum.html", {.units = {"m", "s", "N"}});
///
/// Numbers are those of the samples, and of the instants of events; between samples the picture alone is
/// interpolated. Driven points and curves are drawn by calling their functions: these must capture by value.
///
/// Throws InvalidArgument for a run without samples, Error if the file cannot be written.
template <int D>
void write_html(const Trajectory<D>& run, const std::filesystem::path& path,
                const PageOptions& options = {}) {
  detail::write_page(*run.record(), nullptr, path, options);
}
/// The same with the errors of all numbers, and what is known of them.
template <int D>
void write_html(const Certificate<D>& certificate, const std::filesystem::path& path,
                const PageOptions& options = {}) {
  detail::write_page(*certificate.run().record(), &certificate.runs(), path, options);
}

}  // namespace dalembert
