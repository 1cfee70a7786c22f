#pragma once

#include <dalembert/view/json.h>
#include <dalembert/view/quantities.h>

#include <string>
#include <utility>
#include <vector>

namespace DALEMBERT_HIDDEN dalembert {

/// The accounts of a run's ledger as columns of a page.
class PageLedger {
 public:
  PageLedger(const Record& run, Quantities& all);
  void write(Json& json) const;

 private:
  std::vector<std::pair<std::string, std::size_t>> accounts_;
};

}  // namespace dalembert
