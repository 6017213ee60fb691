// What only the emulator knows, once an exchange: one row of truth.csv.
#pragma once

#include <cstdint>

#include "core/axis.h"
#include "core/error.h"
#include "core/time.h"
#include "protocol/messages.h"

namespace towbench::emulator {

struct AxisTruth {
  double motor_angle_rad = 0;
  double motor_speed_rad_per_s = 0;
  double carriage_m = 0;  // true position in the tank, 0 at encoder count 0
  double carriage_speed_m_per_s = 0;
  double current_A = 0;
  double motor_torque_Nm = 0;
  double motor_friction_Nm = 0;
  double carriage_friction_N = 0;
  double transmission_force_N = 0;
  double command_V = 0;
  std::int64_t count = 0;           // floor of the true angle in counts
  std::int64_t edges_total = 0;     // A and B edges sent since the start
  std::int32_t absolute_count = 0;  // what an absolute encoder tells: no truth when it fails
};

struct TruthRow {
  core::Nanoseconds time_ns = 0;
  core::PerAxis<AxisTruth> axes;
  protocol::InputLines input_lines = 0;  // as protocol::DigitalInputs
};

enum class PlantEventKind : std::uint8_t {
  kInputLineChanged,
  kHardEndContact,
  kIndexPulse,
  kFault,
  kScheduledEventFired,
  kPeerLost,
  kDriveRemoved,
  kFinished,
  kOperatorReset,
};

struct PlantEvent {
  core::Nanoseconds time_ns = 0;
  PlantEventKind kind = PlantEventKind::kFinished;
  core::Axis axis = core::kFirstAxis;
  core::ErrorCode code = core::ErrorCode::kNone;
  protocol::InputLines lines = 0;
  double value = 0;  // contact: speed in m/s; scheduled event: its index; reset: 1 when told
  double energy_J = 0;
};

}  // namespace towbench::emulator
