#include "dalembert/view/page_data.h"

#include <dalembert/view/acting_parts.h>
#include <dalembert/view/moving_parts.h>
#include <dalembert/view/page_ledger.h>
#include <dalembert/view/run_summary.h>

#include <algorithm>
#include <optional>

namespace dalembert {

namespace {

/// One attempt at a page: with every so many samples.
class PageData {
 public:
  PageData(const Record& run, const TwoRuns* certified, std::size_t every)
      : run_(run),
        certified_(certified),
        every_(every),
        all_(instants(run, certified, every), certified),
        pictures_(*run.layout, all_),
        moving_(*run.layout, all_),
        acting_(run, all_, pictures_),
        ledger_(run, all_) {
    time_ = all_.columns().add([&](std::size_t i) { return all_.shown()[i].time(); });
    const auto energy = [](const FlatSample& at, std::span<double> out) { out[0] = at.energy; };
    energy_ = all_.add(1, energy).front();
    energy_error_ = all_.add_error(1, Quantities::Kind::other, energy);
  }

  [[nodiscard]] std::size_t bytes(Digits digits) { return all_.columns().bytes(digits); }
  void write(Json& json, Digits digits, const PageOptions& options);

 private:
  void write_heading(Json& json, Digits digits, const PageOptions& options) const;

  const Record& run_;
  const TwoRuns* certified_;
  std::size_t every_;
  Quantities all_;
  Pictures pictures_;
  MovingParts moving_;
  ActingParts acting_;
  PageLedger ledger_;
  std::size_t time_ = 0, energy_ = 0;
  std::optional<std::size_t> energy_error_;
};

void PageData::write_heading(Json& json, Digits digits, const PageOptions& options) const {
  json.member("format", 1);
  json.member("version", DALEMBERT_VERSION);
  json.member("title", options.title.empty() ? run_.layout->scene : options.title);
  json.member("scene", run_.layout->scene);
  json.member("dimension", run_.layout->dimension);
  json.member("stepper", run_.stepper);
  json.member("tolerance", run_.tolerance);
  json.member("samples", run_.times.size());
  json.member("every", every_);
  json.member("digits", digits == Digits::sixteen ? 16 : 7);
  json.object("units", [&] {
    json.member("length", options.units.length);
    json.member("time", options.units.time);
    json.member("force", options.units.force);
  });
  json.member("time", time_);
  json.member("energy", energy_);
  write_error(json, energy_error_, "energyError");
}

void PageData::write(Json& json, Digits digits, const PageOptions& options) {
  json.object([&] {
    write_heading(json, digits, options);
    moving_.write(json, pictures_);
    acting_.write(json, pictures_);
    write_events(json, run_, certified_, all_.shown());
    write_statistics(json, run_.statistics);
    ledger_.write(json);
    write_certificate(json, certified_);
    all_.columns().write(json, digits);
  });
}

}  // namespace

void write_page_data(std::ostream& out, const Record& run, const TwoRuns* certified,
                     const PageOptions& options) {
  Json json(out);
  for (std::size_t every = 1;; ++every) {
    PageData page(run, certified, every);
    for (const Digits digits : {Digits::sixteen, Digits::seven}) {
      const bool least = digits == Digits::seven && every >= run.times.size();
      if (page.bytes(digits) <= options.most_bytes || least) return page.write(json, digits, options);
    }
    // The next one that can do: what is left over of a column goes down as its rows do.
    const auto fraction = page.bytes(Digits::seven) / std::max<std::size_t>(options.most_bytes, 1);
    every = std::max(every, every * fraction);
  }
}

}  // namespace dalembert
