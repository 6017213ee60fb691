#include "emulator/machine_watch.h"

namespace towbench::emulator {

using core::Axis;
using core::ErrorCode;

namespace {

// True once for each time that `now` becomes true.
[[nodiscard]] bool begins(bool& before, bool now) noexcept {
  const bool begun = now && !before;
  before = now;
  return begun;
}

}  // namespace

void MachineWatch::look(const Rig& rig, FaultReporter& faults) noexcept {
  for (const Axis which : rig.axes()) {
    const RigAxis* axis = rig.axis(which);
    if (axis == nullptr) {
      continue;
    }
    if (axis->plant().contact().occurred) {
      look_at_contact(rig, which);
    }
    if (begins(too_fast_[which], axis->encoder().too_fast())) {
      faults.report(rig.now_ns(), ErrorCode::kEncoderRateExceeded, which,
                    static_cast<std::uint32_t>(which));
    }
  }
  if (begins(tripped_, rig.supply().tripped())) {
    faults.report(rig.now_ns(), ErrorCode::kSupplyOverCurrent, core::kFirstAxis, 0);
  }
  if (begins(cut_out_, rig.supply().cut_out())) {
    faults.report(rig.now_ns(), ErrorCode::kSupplyUnderVoltage, core::kFirstAxis, 0);
  }
}

void MachineWatch::look_at_contact(const Rig& rig, Axis which) noexcept {
  const HardEndContact& contact = rig.axis(which)->plant().contact();
  observer_->on_event(
      {.time_ns = rig.now_ns() - core::kPlantTick_ns + core::nanoseconds(contact.time_s),
       .kind = PlantEventKind::kHardEndContact,
       .axis = which,
       .code = ErrorCode::kHardEndContact,
       .lines = rig.lines(),
       .value = contact.speed_m_per_s,
       .energy_J = contact.energy_J});
}

}  // namespace towbench::emulator
