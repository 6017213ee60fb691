// What both ways to write a fault share.
#pragma once

#include <array>
#include <string_view>

#include "core/parameter.h"
#include "harness/fault_plan/fault.h"
#include "harness/fixtures/fixture_error.h"

namespace towbench::harness {

inline constexpr double kLongestFaultTime_s = 86'400.0;

struct TriggerKey {
  std::string_view key;
  FaultTrigger::Kind kind;
  core::Range range;
};
// In the order of FaultTrigger::Kind.
inline constexpr std::array<TriggerKey, 3> kNumericTriggers{{
    {"at_s", FaultTrigger::Kind::kTime, core::between(0, kLongestFaultTime_s)},
    {"position_m", FaultTrigger::Kind::kPosition, core::between(-100, 100)},
    {"speed_m_per_s", FaultTrigger::Kind::kSpeed, core::between(1e-4, 10)},
}};

// Phases of an axis' motion: rest (no drive), hold (driven, reference stands), accelerate, cruise,
// decelerate, reverse (about a change of direction), open_loop (a duty is commanded), brake.
inline constexpr std::array<std::string_view, 8> kPhaseNames{
    "rest", "hold", "accelerate", "cruise", "decelerate", "reverse", "open_loop", "brake"};
inline constexpr std::array<std::string_view, 10> kEventNames{
    "motion", "motion_end", "y_min",  "y_max",       "x_min",
    "x_max",  "y_home",     "x_home", "kill_switch", "fault"};

// Throws FixtureError when the fault as a whole cannot be: without a trigger, or built in and with
// one.
void check_whole(const Fault& fault, bool has_trigger, const FixtureError::Place& place);

}  // namespace towbench::harness
