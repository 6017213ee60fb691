#include "study/procedures/memory_recorder.h"

#include <fmt/format.h>

#include "core/error.h"

namespace towbench::study::procedures {

void MemoryRecorder::drain(bbmc::ControllerNode& controller) noexcept {
  bbmc::TelemetryRow row;
  while (controller.next_row(row)) {
    if (fault_ == core::ErrorCode::kNone) {
      fault_ = row.fault;
    }
    keep(row);
  }
  bbmc::ControllerEvent event;
  while (controller.next_event(event)) {
  }
}

void MemoryRecorder::keep(const bbmc::TelemetryRow& row) {
  if (!keeps_idle_rows_) {
    bool idle = true;
    for (const auto& axis : row.axes) {
      idle = idle && axis.mode == bbmc::AxisMode::kIdle && axis.edges == 0;
    }
    if (idle) {
      return;
    }
  }
  recording_.time_s.push_back(core::seconds(row.time_ns));
  for (const auto which : core::kPlanarAxes) {
    const auto& from = row.axes[which];
    auto& to = recording_.axes[which];
    to.count.push_back(from.count);
    to.duty_pct.push_back(from.duty_pct);
    to.reference_m.push_back(from.reference_m);
    to.reference_velocity_m_per_s.push_back(from.reference_velocity_m_per_s);
    to.velocity_m_per_s.push_back(from.velocity_m_per_s);
    to.mode.push_back(static_cast<std::uint8_t>(from.mode));
    if (has_current_[which]) {
      to.current_A.resize(recording_.rows() - 1, 0.0);  // rows before the first sample
      to.current_A.push_back(current_A_[which]);
    }
    if (has_force_) {
      recording_.force_N[which].resize(recording_.rows() - 1, 0.0);
      recording_.force_N[which].push_back(force_N_[which]);
    }
  }
}

void MemoryRecorder::on(const protocol::ForceSample& sample) noexcept {
  has_force_ = true;
  force_N_[core::Axis::kX] = static_cast<double>(sample.force_N[0]);
  force_N_[core::Axis::kY] = static_cast<double>(sample.force_N[1]);
}

void MemoryRecorder::on(const protocol::CurrentSample& sample) noexcept {
  has_current_[sample.axis] = true;
  current_A_[sample.axis] = static_cast<double>(sample.armature_current_A);
}

identify::Recording MemoryRecorder::take() {
  if (fault_ != core::ErrorCode::kNone) {
    recording_.trouble =
        fmt::format("fault {} was latched: {}", core::number_of(fault_), core::describe(fault_));
  }
  return std::move(recording_);
}

}  // namespace towbench::study::procedures
