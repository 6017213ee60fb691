// One built-in axis as an FMI 3.0 Co-Simulation unit that needs nothing but itself: the binary of
// `towbench export-fmu`. What an axis does not have (events, other types, derivatives) is an error.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "emulator/fmi/axis_variables.h"
#include "emulator/fmi/fmi3.h"
#include "emulator/fmi/parameter_lines.h"
#include "emulator/plant/axis_plant.h"

using towbench::emulator::AxisInput;
using towbench::emulator::AxisParameters;
using towbench::emulator::AxisPlant;
using namespace towbench::fmi3;

namespace {

// A step is a whole number of ticks within this part of one.
constexpr double kTickTolerance = 1e-6;
constexpr double kLongestStep_s = 1.0;

struct AxisUnit {
  AxisParameters parameters;
  double start_m = 0;
  AxisInput input;
  std::unique_ptr<AxisPlant> plant;  // null before the end of initialisation
  void* environment = nullptr;
  LogMessage log = nullptr;

  [[nodiscard]] Status refuse(const char* why) const {
    if (log != nullptr) {
      log(environment, Status::kError, "error", why);
    }
    return Status::kError;
  }
};

AxisUnit& unit_of(Instance instance) {
  return *static_cast<AxisUnit*>(instance);
}

// `folder` is fmi3's resourcePath: it ends with a separator.
bool read_parameters(AxisUnit& unit, const char* folder) {
  std::ifstream stream(std::string(folder) + std::string(kAxisParameterFile));
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  LineReader reader(text);
  unit.parameters.visit(reader);
  reader.value("start_m", unit.start_m, {}, "");
  reader.value("supply_V", unit.input.supply_V, {}, "");
  return reader.complete() && towbench::emulator::inconsistency(unit.parameters) == nullptr;
}

double* input_of(AxisUnit& unit, ValueReference reference) {
  switch (static_cast<AxisVariable>(reference)) {
    case AxisVariable::kCommand:
      return &unit.input.command_V;
    case AxisVariable::kExternalForce:
      return &unit.input.carriage_force_N;
    case AxisVariable::kSupply:
      return &unit.input.supply_V;
    case AxisVariable::kStart:
      return unit.plant ? nullptr : &unit.start_m;
    default:
      return nullptr;
  }
}

// Before the end of initialisation the axis rests at its start.
bool output_of(const AxisUnit& unit, ValueReference reference, double& value) {
  const AxisPlant at_rest = unit.plant ? *unit.plant : AxisPlant(unit.parameters, unit.start_m);
  const auto state = at_rest.state();
  switch (static_cast<AxisVariable>(reference)) {
    case AxisVariable::kAngle:
      value = state.motor_angle_rad;
      return true;
    case AxisVariable::kSpeed:
      value = state.motor_speed_rad_per_s;
      return true;
    case AxisVariable::kPosition:
      value = state.carriage_m;
      return true;
    case AxisVariable::kVelocity:
      value = state.carriage_speed_m_per_s;
      return true;
    case AxisVariable::kForce:
      value = at_rest.forces().transmission_force_N;
      return true;
    case AxisVariable::kCurrent:
      value = state.current_A;
      return true;
    default:
      return false;
  }
}

}  // namespace

extern "C" {

const char* fmi3GetVersion() {
  return kVersion;
}

Instance fmi3InstantiateCoSimulation(const char* /*name*/, const char* /*token*/,
                                     const char* resource_path, bool /*visible*/,
                                     bool /*logging_on*/, bool event_mode_used,
                                     bool /*early_return_allowed*/, const ValueReference[],
                                     std::size_t /*required_count*/, void* environment,
                                     LogMessage log, IntermediateUpdate /*update*/) {
  auto unit = std::make_unique<AxisUnit>();
  unit->environment = environment;
  unit->log = log;
  unit->input.amplifier_enabled = true;
  if (event_mode_used || resource_path == nullptr || !read_parameters(*unit, resource_path)) {
    (void)unit->refuse("resources/axis.txt is missing or incomplete, or event mode is asked for");
    return nullptr;
  }
  return unit.release();
}

void fmi3FreeInstance(Instance instance) {
  delete static_cast<AxisUnit*>(instance);
}

Status fmi3EnterInitializationMode(Instance instance, bool /*tolerance_defined*/,
                                   double /*tolerance*/, double start_time, bool /*stop_defined*/,
                                   double /*stop_time*/) {
  return std::isfinite(start_time) ? Status::kOk : unit_of(instance).refuse("no start time");
}

Status fmi3ExitInitializationMode(Instance instance) {
  auto& unit = unit_of(instance);
  unit.plant = std::make_unique<AxisPlant>(unit.parameters, unit.start_m);
  return Status::kOk;
}

Status fmi3Terminate(Instance /*instance*/) {
  return Status::kOk;
}

Status fmi3Reset(Instance instance) {
  auto& unit = unit_of(instance);
  unit.plant.reset();
  unit.input = {.supply_V = unit.input.supply_V, .amplifier_enabled = true};
  return Status::kOk;
}

Status fmi3GetFloat64(Instance instance, const ValueReference references[], std::size_t count,
                      double values[], std::size_t value_count) {
  auto& unit = unit_of(instance);
  for (std::size_t i = 0; i < std::min(count, value_count); ++i) {
    if (const double* input = input_of(unit, references[i])) {
      values[i] = *input;
    } else if (!output_of(unit, references[i], values[i])) {
      return unit.refuse("no such Float64 variable");
    }
  }
  return Status::kOk;
}

Status fmi3SetFloat64(Instance instance, const ValueReference references[], std::size_t count,
                      const double values[], std::size_t value_count) {
  auto& unit = unit_of(instance);
  for (std::size_t i = 0; i < std::min(count, value_count); ++i) {
    double* const input = input_of(unit, references[i]);
    if (input == nullptr || !std::isfinite(values[i])) {
      return unit.refuse("no variable that can be set now, or no finite value");
    }
    *input = values[i];
  }
  return Status::kOk;
}

Status fmi3GetBoolean(Instance instance, const ValueReference references[], std::size_t count,
                      bool values[], std::size_t /*value_count*/) {
  for (std::size_t i = 0; i < count; ++i) {
    if (references[i] != static_cast<ValueReference>(AxisVariable::kEnabled)) {
      return unit_of(instance).refuse("no such Boolean variable");
    }
    values[i] = unit_of(instance).input.amplifier_enabled;
  }
  return Status::kOk;
}

Status fmi3SetBoolean(Instance instance, const ValueReference references[], std::size_t count,
                      const bool values[], std::size_t /*value_count*/) {
  for (std::size_t i = 0; i < count; ++i) {
    if (references[i] != static_cast<ValueReference>(AxisVariable::kEnabled)) {
      return unit_of(instance).refuse("no such Boolean variable");
    }
    unit_of(instance).input.amplifier_enabled = values[i];
  }
  return Status::kOk;
}

Status fmi3DoStep(Instance instance, double time, double step, bool /*no_set_state_before*/,
                  bool* event_needed, bool* terminate_wanted, bool* early_return,
                  double* last_time) {
  auto& unit = unit_of(instance);
  const double ticks = step / towbench::core::kPlantTick_s;
  const double whole = std::round(ticks);
  *event_needed = *terminate_wanted = *early_return = false;
  *last_time = time;
  if (!unit.plant || !(step <= kLongestStep_s) || !(whole >= 1) ||
      std::fabs(ticks - whole) > kTickTolerance) {
    return unit.refuse("a step is a whole number of 100 us, 1 s at most, after initialisation");
  }
  towbench::emulator::MotionSegments segments;
  for (int tick = 0; tick < static_cast<int>(whole); ++tick) {
    unit.plant->step(unit.input, segments);
  }
  *last_time = time + step;
  return Status::kOk;
}

// A state is a copy of the axis with its inputs.
Status fmi3GetFMUState(Instance instance, State* state) {
  auto& unit = unit_of(instance);
  auto* const copy = *state == nullptr ? new AxisUnit : static_cast<AxisUnit*>(*state);
  copy->start_m = unit.start_m;
  copy->input = unit.input;
  copy->plant = unit.plant ? std::make_unique<AxisPlant>(*unit.plant) : nullptr;
  *state = copy;
  return Status::kOk;
}

Status fmi3SetFMUState(Instance instance, State state) {
  auto& unit = unit_of(instance);
  const auto& copy = *static_cast<AxisUnit*>(state);
  unit.start_m = copy.start_m;
  unit.input = copy.input;
  unit.plant = copy.plant ? std::make_unique<AxisPlant>(*copy.plant) : nullptr;
  return Status::kOk;
}

Status fmi3FreeFMUState(Instance /*instance*/, State* state) {
  delete static_cast<AxisUnit*>(*state);
  *state = nullptr;
  return Status::kOk;
}

Status fmi3SetDebugLogging(Instance /*instance*/, bool /*on*/, std::size_t /*count*/,
                           const char* const /*categories*/[]) {
  return Status::kOk;
}

// A unit defines all of the interface; an axis has no such variables and modes.
#define TOWBENCH_NOT_OF_AN_AXIS(name)                         \
  Status name(Instance instance, ...) {                       \
    return unit_of(instance).refuse("an axis has no " #name); \
  }
TOWBENCH_NOT_OF_AN_AXIS(fmi3EnterEventMode)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetFloat32)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetInt8)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetUInt8)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetInt16)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetUInt16)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetInt32)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetUInt32)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetInt64)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetUInt64)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetString)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetBinary)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetClock)
TOWBENCH_NOT_OF_AN_AXIS(fmi3SetFloat32)
TOWBENCH_NOT_OF_AN_AXIS(fmi3SetInt8)
TOWBENCH_NOT_OF_AN_AXIS(fmi3SetUInt8)
TOWBENCH_NOT_OF_AN_AXIS(fmi3SetInt16)
TOWBENCH_NOT_OF_AN_AXIS(fmi3SetUInt16)
TOWBENCH_NOT_OF_AN_AXIS(fmi3SetInt32)
TOWBENCH_NOT_OF_AN_AXIS(fmi3SetUInt32)
TOWBENCH_NOT_OF_AN_AXIS(fmi3SetInt64)
TOWBENCH_NOT_OF_AN_AXIS(fmi3SetUInt64)
TOWBENCH_NOT_OF_AN_AXIS(fmi3SetString)
TOWBENCH_NOT_OF_AN_AXIS(fmi3SetBinary)
TOWBENCH_NOT_OF_AN_AXIS(fmi3SetClock)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetNumberOfVariableDependencies)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetVariableDependencies)
TOWBENCH_NOT_OF_AN_AXIS(fmi3SerializedFMUStateSize)
TOWBENCH_NOT_OF_AN_AXIS(fmi3SerializeFMUState)
TOWBENCH_NOT_OF_AN_AXIS(fmi3DeserializeFMUState)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetDirectionalDerivative)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetAdjointDerivative)
TOWBENCH_NOT_OF_AN_AXIS(fmi3EnterConfigurationMode)
TOWBENCH_NOT_OF_AN_AXIS(fmi3ExitConfigurationMode)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetIntervalDecimal)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetIntervalFraction)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetShiftDecimal)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetShiftFraction)
TOWBENCH_NOT_OF_AN_AXIS(fmi3SetIntervalDecimal)
TOWBENCH_NOT_OF_AN_AXIS(fmi3SetIntervalFraction)
TOWBENCH_NOT_OF_AN_AXIS(fmi3SetShiftDecimal)
TOWBENCH_NOT_OF_AN_AXIS(fmi3SetShiftFraction)
TOWBENCH_NOT_OF_AN_AXIS(fmi3EvaluateDiscreteStates)
TOWBENCH_NOT_OF_AN_AXIS(fmi3UpdateDiscreteStates)
TOWBENCH_NOT_OF_AN_AXIS(fmi3EnterStepMode)
TOWBENCH_NOT_OF_AN_AXIS(fmi3GetOutputDerivatives)
#undef TOWBENCH_NOT_OF_AN_AXIS

}  // extern "C"
