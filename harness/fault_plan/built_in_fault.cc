#include "harness/fault_plan/built_in_fault.h"

namespace towbench::harness {

using enum FaultKind;

void build_in(const Fault& fault, emulator::RigParameters& rig) {
  auto& axis = rig.axes[fault.place.axis];
  auto& hall = fault.place.at_max ? axis.hall_max : axis.hall_min;
  switch (fault.kind) {
    case kLate:
      hall.delay_s = fault.parameters[0];
      break;
    case kMissing:
      hall.fitted = false;
      break;
    case kDisplaced:
      hall.position_m += fault.parameters[0];
      break;
    case kLatching:
      hall.latching = true;
      break;
    case kBacklash:
      axis.plant.gear.backlash_deg = fault.parameters[0];
      break;
    case kPhase:
      axis.encoder.phase_deg = fault.parameters[0];
      break;
    default:
      break;
  }
}

}  // namespace towbench::harness
