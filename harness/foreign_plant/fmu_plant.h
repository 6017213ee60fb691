// A Functional Mock-up Unit (FMI 3.0, Co-Simulation) as a plant.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "harness/fmi/unpacked_fmu.h"
#include "harness/foreign_plant/loaded_plant.h"

namespace towbench::harness {

// Variables of one axis by the name of what the bench gives or takes. Blank: not connected.
struct FmuAxis {
  // Of towbench_plant_input; `enabled` is a Boolean, all others Float64.
  std::string command_V, voltage_V, current_A, drive_force_N, external_force_N, supply_V, enabled;
  std::string start_m;  // a parameter: where the load rests at the start
  // Of towbench_plant_output. Motor values that are not connected follow from those of the load.
  std::string position_m, velocity_m_per_s, motor_angle_rad, motor_speed_rad_per_s, force_N,
      winding_A;
  double metres_per_motor_rad = 1;
};

struct FmuStart {
  std::string name;
  double value = 0;
};

// Empty, or what is wrong in half a sentence: a variable that the unit lacks, one of another type
// or causality, a step that does not divide 100 us.
[[nodiscard]] std::string misfit(const FmuDescription& unit, const FmuAxis& axis);
[[nodiscard]] std::string misfit(const FmuDescription& unit, const FmuStart& start);

class FmuBinary final : public PlantBinary {
 public:
  // One FmuAxis for each axis of the machine, in order; all of them fit.
  FmuBinary(std::shared_ptr<const UnpackedFmu> unit, std::vector<FmuAxis> axes,
            std::vector<FmuStart> starts)
      : unit_(std::move(unit)), axes_(std::move(axes)), starts_(std::move(starts)) {}

  [[nodiscard]] std::unique_ptr<LoadedPlant> load(const std::vector<PlantAxis>& axes,
                                                  std::string& why) const override;

 private:
  std::shared_ptr<const UnpackedFmu> unit_;
  std::vector<FmuAxis> axes_;
  std::vector<FmuStart> starts_;
};

}  // namespace towbench::harness
