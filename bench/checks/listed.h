#pragma once

#include <dalembert/bench/command_line.h>

/// The commands of dalembert-checks, which are dalembert-bench's too: it passes them on.
namespace dalembert::bench::listed {

inline constexpr Listed extremes{
    "extremes", "Stiff, extreme and hostile scenes: error against its limit, or the refusal that is due"};
inline constexpr Listed audit{
    "audit", "Every law of mechanics that a result must obey against its limit, in all models and extremes"};
inline constexpr Listed modes{
    "modes", "Equilibria, forces of constraint there and small motions against closed forms"};
inline constexpr Listed events{"events",
                               "Times of impacts, of rest and of forces that vanish against closed forms"};
inline constexpr Listed certificates{
    "certificates", "Errors that certify estimates against the true ones, in all models and events"};
inline constexpr Listed requests{
    "requests", "Errors of force that simulate_to is asked for, what it gives, and at what cost"};
inline constexpr Listed diagrams{
    "diagrams", "Tables of branches of equilibria and of Kapitza's stability chart, which diagrams.gp draws"};

inline constexpr Listed of_checks[] = {extremes, audit, modes, events, certificates, requests, diagrams};

}  // namespace dalembert::bench::listed
