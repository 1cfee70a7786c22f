#include <dalembert/bench/checks/commands.h>
#include <dalembert/bench/checks/listed.h>

namespace dalembert::bench {
namespace {

const Command commands[] = {
    {listed::extremes, running(extremes,
                               [](CLI::App& command, ExtremesOptions& o) {
                                 add(command, "--case", o.cases, "all, or names as in the table");
                                 command.add_flag("--quick", o.quick,
                                                  "Only the part of each sweep that takes seconds");
                               })},
    {listed::audit,
     running(audit,
             [](CLI::App& command, AuditOptions& o) {
               add_tolerance(command, o.tolerances);
               add_repeats(command, o.repeats, "Pairs of runs of which the median cost counts; 0: none", 0);
               command.add_flag("--quick", o.quick, "Of the extremes only the part that takes seconds");
             })},
    {listed::modes,
     running(modes,
             [](CLI::App& command, ModesOptions& o) {
               add(command, "--size", o.beads, "Beads of the long chain")->check(CLI::Range(300, 1'000'000));
             })},
    {listed::events, running(events, [](CLI::App&, EventsOptions&) {})},
    {listed::certificates, running(certificates,
                                   [](CLI::App& command, CertificatesOptions& o) {
                                     add_tolerance(command, o.tolerances);
                                     command.add_flag("--quick", o.quick, "Two tolerances only");
                                   })},
    {listed::requests,
     running(
         requests,
         [](CLI::App& command, RequestsOptions& o) {
           add_models(command, o.models);
           add(command, "--error", o.errors, "Of force, relative to the model's")->check(CLI::PositiveNumber);
           add_repeats(command, o.repeats, "Runs of which the median time counts");
         })},
    {listed::diagrams,
     running(
         diagrams,
         [](CLI::App& command, DiagramsOptions& o) {
           add(command, "--directory", o.directory, "Where the tables go");
           add(command, "--points", o.points, "Of the chart along either axis")->check(CLI::Range(2, 1000));
         })},
};

}  // namespace
}  // namespace dalembert::bench

int main(int argc, char** argv) {
  using namespace dalembert::bench;
  return run_commands("dalembert-checks", "Results against closed forms, laws and their own claims", commands,
                      argc, argv);
}
