#include "harness/fault_plan/built_in_fault.h"

namespace towbench::harness {

using enum FaultKind;

namespace {

// Of a hall sensor or a home switch.
template <typename Switch>
void build_in_switch(const Fault& fault, Switch& built) {
  switch (fault.kind) {
    case kLate:
      built.delay_s = fault.parameters[0];
      break;
    case kMissing:
      built.fitted = false;
      break;
    case kDisplaced:
      built.position_m += fault.parameters[0];
      break;
    default:
      break;
  }
}

}  // namespace

void build_in(const Fault& fault, emulator::RigParameters& rig) {
  auto& axis = rig.axes[fault.place.axis];
  auto& hall = fault.place.at_max ? axis.hall_max : axis.hall_min;
  if (fault.place.part == FaultPart::kEndStop) {
    build_in_switch(fault, hall);
  } else if (fault.place.part == FaultPart::kHomeSwitch) {
    build_in_switch(fault, axis.home);
  }
  switch (fault.kind) {
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
