#include "dalembert/core/results/event.h"

namespace dalembert {

const char* name(EventKind kind) {
  switch (kind) {
    case EventKind::event:
      return "happens";
    case EventKind::opened:
      return "opens";
    case EventKind::struck:
      return "is struck";
    case EventKind::rested:
      return "comes to rest";
    case EventKind::sticks:
      return "sticks";
    case EventKind::slides:
      return "slides";
  }
  return "";
}

}  // namespace dalembert
