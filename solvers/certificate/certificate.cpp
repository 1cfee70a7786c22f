#include "dalembert/solvers/certificate/certificate.h"

#include <dalembert/solvers/certificate/better_run.h>
#include <dalembert/solvers/certificate/statement.h>

namespace dalembert {

template <int D>
Certificate<D>::Certificate(TwoRuns runs)
    : runs_(std::move(runs)), run_(runs_.run()), reference_(runs_.reference()) {}
template <int D>
Certificate<D>::~Certificate() = default;
template <int D>
Certificate<D>::Certificate(const Certificate&) = default;
template <int D>
Certificate<D>& Certificate<D>::operator=(const Certificate&) = default;

template <int D>
std::string Certificate<D>::statement() const {
  return dalembert::statement(runs_, largest());
}

template <int D>
Certificate<D> certify(const Scene<D>& scene, const Options& options, const std::vector<Event<D>>& events) {
  return Certificate<D>(
      run_twice([&](const Options& own) { return simulate(scene, own, events).record(); }, options));
}

template class Certificate<2>;
template class Certificate<3>;
template Certificate<2> certify(const Scene<2>&, const Options&, const std::vector<Event<2>>&);
template Certificate<3> certify(const Scene<3>&, const Options&, const std::vector<Event<3>>&);

}  // namespace dalembert
