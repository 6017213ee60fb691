#include "harness/fault_plan/fault_fit.h"

namespace towbench::harness {

const char* lacking(const Fault& fault, const emulator::RigParameters& rig) noexcept {
  if (!is_of_an_axis(fault.place.part)) {
    return nullptr;
  }
  const auto& axis = rig.axes[fault.place.axis];
  if (!axis.exists) {
    return "an axis that the rig has";
  }
  const FaultNeeds needs = fault.row().needs;
  if (needs == FaultNeeds::kHomeSwitch && !axis.home.fitted) {
    return "an axis with a home switch: the rig has no table home of it";
  }
  if (needs == FaultNeeds::kHoldingBrake && !axis.brake.fitted) {
    return "an axis with a holding brake: the rig has no table brake of it";
  }
  return nullptr;
}

}  // namespace towbench::harness
