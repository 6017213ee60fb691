// The variables of an exported axis: one table for its description and for its binary.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace towbench::fmi3 {

enum class AxisVariable : std::uint32_t {
  kTime,
  kCommand,
  kExternalForce,
  kSupply,
  kEnabled,
  kStart,
  kAngle,
  kSpeed,
  kPosition,
  kVelocity,
  kForce,
  kCurrent,
};

enum class Causality : std::uint8_t { kIndependent, kInput, kParameter, kOutput };

struct AxisVariableRow {
  AxisVariable reference;  // its number is FMI's value reference
  std::string_view name;
  Causality causality;
  std::string_view unit;
  std::string_view meaning;
};

// Boolean: kEnabled. All others are Float64.
inline constexpr std::array kAxisVariables{
    AxisVariableRow{AxisVariable::kTime, "time", Causality::kIndependent, "s", "simulated time"},
    AxisVariableRow{AxisVariable::kCommand, "command_V", Causality::kInput, "V",
                    "voltage at the amplifier's input"},
    AxisVariableRow{AxisVariable::kExternalForce, "external_force_N", Causality::kInput, "N",
                    "force on the load from outside"},
    AxisVariableRow{AxisVariable::kSupply, "supply_V", Causality::kInput, "V",
                    "supply of the amplifier"},
    AxisVariableRow{AxisVariable::kEnabled, "enabled", Causality::kInput, "",
                    "whether the amplifier drives"},
    AxisVariableRow{AxisVariable::kStart, "start_m", Causality::kParameter, "m",
                    "where the load rests at the start"},
    AxisVariableRow{AxisVariable::kAngle, "motor_angle_rad", Causality::kOutput, "rad",
                    "angle of the motor shaft"},
    AxisVariableRow{AxisVariable::kSpeed, "motor_speed_rad_per_s", Causality::kOutput, "rad/s",
                    "speed of the motor shaft"},
    AxisVariableRow{AxisVariable::kPosition, "position_m", Causality::kOutput, "m",
                    "position of the load"},
    AxisVariableRow{AxisVariable::kVelocity, "velocity_m_per_s", Causality::kOutput, "m/s",
                    "speed of the load"},
    AxisVariableRow{AxisVariable::kForce, "force_N", Causality::kOutput, "N",
                    "of the transmission on the load"},
    AxisVariableRow{AxisVariable::kCurrent, "current_A", Causality::kOutput, "A",
                    "in the motor's winding"}};

// Its parameters: lines of "dotted.key value ..." in this file of resources/.
inline constexpr std::string_view kAxisParameterFile = "axis.txt";
inline constexpr std::string_view kAxisModel = "towbench_axis";

}  // namespace towbench::fmi3
