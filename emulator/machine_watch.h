// Notices what goes wrong in the machine, once each time it begins: hard-end contacts, an encoder
// that runs faster than its channels carry, a supply that trips or sags too far.
#pragma once

#include "core/axis.h"
#include "core/realtime.h"
#include "emulator/fault_reporter.h"
#include "emulator/plant_node.h"
#include "emulator/rig.h"

namespace towbench::emulator {

class MachineWatch {
 public:
  explicit MachineWatch(PlantObserver& observer) noexcept : observer_(&observer) {}

  // After each tick of the rig.
  TOWBENCH_REALTIME void look(const Rig& rig, FaultReporter& faults) noexcept;

 private:
  void look_at_contact(const Rig& rig, core::Axis which) noexcept;

  PlantObserver* observer_;
  core::PerAxis<bool> too_fast_{};
  bool tripped_ = false;
  bool cut_out_ = false;
};

}  // namespace towbench::emulator
