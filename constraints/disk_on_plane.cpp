#include "dalembert/constraints/disk_on_plane.h"

namespace dalembert::detail {

template struct LeaningDisk<VecOf<Dual<9>, 3>>;
template struct LeaningDisk<VecOf<Jet<9>, 3>>;
template struct LeaningDisk<VecOf<HyperDual<9>, 3>>;

}  // namespace dalembert::detail
