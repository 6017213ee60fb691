// The bench's own axes behind clients/plant/plant_abi.h: nominal machine, amplifier included. With
// the parameter `ends = false` its axes have no hard ends: the bench makes them.
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

#include "clients/plant/plant_abi.h"
#include "emulator/plant/axis_plant.h"
#include "emulator/rig_parameters.h"

using namespace towbench::emulator;
using towbench::core::Axis;

namespace {

struct Machine {
  std::vector<AxisPlant> axes;
  double time_s = 0;
  MotionSegments segments;
};

}  // namespace

std::uint32_t towbench_plant_abi_version() {
  return TOWBENCH_PLANT_ABI_VERSION;
}

void* towbench_plant_create(const towbench_plant_setup* setup, char* /*message*/,
                            std::size_t /*size*/) {
  auto machine = std::make_unique<Machine>();
  for (std::size_t i = 0; i < setup->axis_count; ++i) {
    const bool is_y = std::string_view(setup->axes[i].name) == "y";
    auto nominal = RigParameters().axes[is_y ? Axis::kY : Axis::kX].plant;
    nominal.hard_ends.fitted = std::string_view(setup->parameters) != "ends = false\n";
    machine->axes.emplace_back(nominal, setup->axes[i].start_m);
  }
  return machine.release();
}

void towbench_plant_destroy(void* plant) {
  delete static_cast<Machine*>(plant);
}

int towbench_plant_step(void* plant, double until_s, const towbench_plant_input* inputs,
                        towbench_plant_output* outputs, double* reached_s, char* /*message*/,
                        std::size_t /*size*/) {
  auto& machine = *static_cast<Machine*>(plant);
  for (std::size_t i = 0; i < machine.axes.size(); ++i) {
    AxisPlant& axis = machine.axes[i];
    if (until_s > machine.time_s) {
      axis.step({.command_V = inputs[i].command_V,
                 .supply_V = inputs[i].supply_V,
                 .carriage_force_N = inputs[i].external_force_N,
                 .amplifier_enabled = inputs[i].enabled != 0},
                machine.segments);
    }
    const AxisState s = axis.state();
    outputs[i] = {.position_m = s.carriage_m,
                  .velocity_m_per_s = s.carriage_speed_m_per_s,
                  .motor_angle_rad = s.motor_angle_rad,
                  .motor_speed_rad_per_s = s.motor_speed_rad_per_s,
                  .force_N = axis.forces().transmission_force_N,
                  .current_A = s.current_A};
  }
  machine.time_s = until_s;
  *reached_s = until_s;
  return 0;
}

// Not offered.
std::size_t towbench_plant_state_size(void* /*plant*/) {
  return 0;
}
int towbench_plant_save(void* /*plant*/, void* /*state*/) {
  return 1;
}
int towbench_plant_restore(void* /*plant*/, const void* /*state*/) {
  return 1;
}
