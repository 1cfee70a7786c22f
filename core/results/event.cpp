#include "dalembert/core/results/event.h"

namespace dalembert {

const char* name(Happened what) {
  switch (what) {
    case Happened::event:
      return "happens";
    case Happened::opened:
      return "opens";
    case Happened::struck:
      return "is struck";
    case Happened::rested:
      return "comes to rest";
    case Happened::sticks:
      return "sticks";
    case Happened::slides:
      return "slides";
  }
  return "";
}

}  // namespace dalembert
