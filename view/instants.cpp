#include "dalembert/view/instants.h"

namespace dalembert {

namespace {

void show_event(const Record& run, const TwoRuns* certified, std::size_t k, std::vector<Shown>& all) {
  if (!run.at_events) return;
  const auto show = [&](const Record& own, const Record* reference) {
    all.push_back({.record = &own, .number = k, .event = k});
    if (certified == nullptr || reference == nullptr) return;
    all.back().certainty = &certified->event(k);
    all.back().reference = reference;
  };
  const Record* const reference = certified == nullptr ? nullptr : certified->reference().get();
  show(*run.at_events, reference == nullptr ? nullptr : reference->at_events.get());
  if (run.after_events)
    show(*run.after_events, reference == nullptr ? nullptr : reference->after_events.get());
}

}  // namespace

std::vector<Shown> instants(const Record& run, const TwoRuns* certified, std::size_t every) {
  std::vector<Shown> all;
  std::size_t k = 0;
  for (std::size_t i = 0; i < run.times.size(); ++i) {
    // At the time of a sample what happened comes behind it.
    for (; k < run.events.size() && run.events[k].time < run.times[i]; ++k)
      show_event(run, certified, k, all);
    if (i % every != 0 && i + 1 != run.times.size()) continue;
    all.push_back({.record = &run, .number = i});
    if (certified == nullptr) continue;
    all.back().certainty = &certified->sample(i);
    all.back().reference = certified->reference().get();
  }
  for (; k < run.events.size(); ++k) show_event(run, certified, k, all);
  return all;
}

}  // namespace dalembert
