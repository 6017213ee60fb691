// The conversation of a run: the controller against a plant, with what the plan puts between them.
#pragma once

#include "harness/link/peer_control.h"
#include "harness/link/plant_end.h"
#include "harness/run/run_plan.h"

namespace towbench::harness {

// Writes the controller's side of the record.
[[nodiscard]] RunOutcome converse(const RunPlan& plan, PlantEnd& plant, PeerControl& peer);

}  // namespace towbench::harness
