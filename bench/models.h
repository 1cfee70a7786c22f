#pragma once

#include <dalembert/models/event_model.h>
#include <dalembert/models/model.h>

#include <string>
#include <vector>

namespace dalembert::bench {

/// The models of these names, or of "all", in the order of the catalogue; throws Error, listing the names,
/// for one that does not exist.
[[nodiscard]] std::vector<models::AnyModel> select_models(const std::vector<std::string>& names);

/// All models whose events have times in closed form.
[[nodiscard]] std::vector<models::EventModel> models_of_events();

}  // namespace dalembert::bench
