// One line of events.jsonl for each event of either side. README.md is the spec.
#pragma once

#include <filesystem>
#include <string>

#include "bbmc/host/controller_node.h"
#include "core/time.h"
#include "emulator/truth_row.h"
#include "harness/experiment/operator_act.h"

namespace towbench::harness {

[[nodiscard]] std::string event_line(const emulator::PlantEvent& event);
[[nodiscard]] std::string event_line(const bbmc::ControllerEvent& event);
// What crossed between the two sides: {"side":"wire"}.
[[nodiscard]] std::string wire_event_line(core::Nanoseconds time_ns, std::string_view kind);

// What a person did: {"side":"operator"}.
[[nodiscard]] std::string operator_act_line(const OperatorAct& act);

inline constexpr const char* kPlantEventsFile = "plant_events.jsonl";
inline constexpr const char* kControllerEventsFile = "controller_events.jsonl";
inline constexpr const char* kEventsFile = "events.jsonl";

// Joins both sides' files in time order (plant first at equal times) and removes them.
void merge_events(const std::filesystem::path& folder);

}  // namespace towbench::harness
