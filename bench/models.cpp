#include "dalembert/bench/models.h"

#include <dalembert/models/catalogue.h>
#include <dalembert/models/chain_over_edge.h>

#include <algorithm>

namespace dalembert::bench {

using models::AnyModel;

std::vector<AnyModel> select_models(const std::vector<std::string>& names) {
  const auto name_of = [](const AnyModel& model) {
    return std::visit([](const auto& m) { return m.name; }, model);
  };
  std::vector<AnyModel> all = models::catalogue();
  if (std::ranges::find(names, "all") != names.end()) return all;
  for (const std::string& name : names) {
    if (std::ranges::find(all, name, name_of) != all.end()) continue;
    std::string known;
    for (const AnyModel& m : all) known += ' ' + name_of(m);
    throw Error("no model \"" + name + "\"; there are: all" + known);
  }
  std::erase_if(all, [&](const AnyModel& m) { return std::ranges::find(names, name_of(m)) == names.end(); });
  return all;
}

std::vector<models::EventModel> models_of_events() {
  auto all = models::models_with_events();
  all.push_back(models::chain_over_edge_model());
  all.push_back(models::chain_over_edge_friction_model());
  return all;
}

}  // namespace dalembert::bench
