// A plant of the user's own in place of the built-in equations: what it is told and what it says,
// once a tick for all axes of the machine. Loading and stepping one: harness/foreign_plant/.
//
// Where the load turns, read rad for m and Nm for N.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/axis.h"
#include "core/realtime.h"

namespace towbench::emulator {

// Constant over one step. The first four are one command as different drives put it out.
struct ForeignInput {
  double command_V = 0;         // at the amplifier's input
  double voltage_V = 0;         // at the motor, of a voltage amplifier
  double current_A = 0;         // in the winding, of a current amplifier
  double drive_force_N = 0;     // at the load, of that current
  double external_force_N = 0;  // on the load, + towards max
  double supply_V = 0;
  bool enabled = false;
};

// At the end of the step; finite.
struct ForeignOutput {
  double position_m = 0;  // of the load
  double velocity_m_per_s = 0;
  double motor_angle_rad = 0;  // of the shaft with the encoder
  double motor_speed_rad_per_s = 0;
  double force_N = 0;  // of the transmission on the load
  double current_A = 0;
};

class ForeignPlant {
 public:
  ForeignPlant() = default;
  ForeignPlant(const ForeignPlant&) = delete;
  ForeignPlant& operator=(const ForeignPlant&) = delete;
  virtual ~ForeignPlant() = default;

  // Goes on to `until_s`; 0, the first call: what holds at the start. False: `outputs` is
  // unchanged, and so it stays; failure() says why.
  [[nodiscard]] virtual bool step(double until_s, const core::PerAxis<ForeignInput>& inputs,
                                  core::PerAxis<ForeignOutput>& outputs) noexcept = 0;
  // One line; empty: none.
  [[nodiscard]] virtual const std::string& failure() const noexcept = 0;
};

// Makes the plant of a run. Shared by all runs of a rig.
class ForeignPlantSource {
 public:
  ForeignPlantSource() = default;
  ForeignPlantSource(const ForeignPlantSource&) = delete;
  ForeignPlantSource& operator=(const ForeignPlantSource&) = delete;
  virtual ~ForeignPlantSource() = default;
  // At rest at time 0 at `starts_m` of the machine's axes; none: it lacks the axis. A plant that
  // cannot be made says so at its first step.
  [[nodiscard]] virtual std::unique_ptr<ForeignPlant> make(
      const core::PerAxis<std::optional<double>>& starts_m) const = 0;
};

}  // namespace towbench::emulator
