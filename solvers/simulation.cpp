#include "dalembert/solvers/simulation.h"

namespace dalembert {

template class Simulation<2>;
template class Simulation<3>;

}  // namespace dalembert
