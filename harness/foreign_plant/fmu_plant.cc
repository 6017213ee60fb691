#include "harness/foreign_plant/fmu_plant.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "core/time.h"
#include "harness/foreign_plant/fmu_functions.h"

namespace towbench::harness {
namespace {

using fmi3::Status;
using fmi3::ValueReference;

constexpr double kSameTime_s = 1e-9;
constexpr int kMostReturns = 1000;  // of one step before its end

struct InputRow {
  const char* name;
  std::string FmuAxis::*variable;
  double towbench_plant_input::*value;
};
constexpr std::array kInputs{
    InputRow{"command_V", &FmuAxis::command_V, &towbench_plant_input::command_V},
    InputRow{"voltage_V", &FmuAxis::voltage_V, &towbench_plant_input::voltage_V},
    InputRow{"current_A", &FmuAxis::current_A, &towbench_plant_input::current_A},
    InputRow{"drive_force_N", &FmuAxis::drive_force_N, &towbench_plant_input::drive_force_N},
    InputRow{"external_force_N", &FmuAxis::external_force_N,
             &towbench_plant_input::external_force_N},
    InputRow{"supply_V", &FmuAxis::supply_V, &towbench_plant_input::supply_V}};

struct OutputRow {
  const char* name;
  std::string FmuAxis::*variable;
  double towbench_plant_output::*value;
};
constexpr std::array kOutputs{
    OutputRow{"position_m", &FmuAxis::position_m, &towbench_plant_output::position_m},
    OutputRow{"velocity_m_per_s", &FmuAxis::velocity_m_per_s,
              &towbench_plant_output::velocity_m_per_s},
    OutputRow{"motor_angle_rad", &FmuAxis::motor_angle_rad,
              &towbench_plant_output::motor_angle_rad},
    OutputRow{"motor_speed_rad_per_s", &FmuAxis::motor_speed_rad_per_s,
              &towbench_plant_output::motor_speed_rad_per_s},
    OutputRow{"force_N", &FmuAxis::force_N, &towbench_plant_output::force_N},
    OutputRow{"current_A", &FmuAxis::winding_A, &towbench_plant_output::current_A}};

std::string misfit_of(const FmuDescription& unit, const char* key, const std::string& name,
                      bool is_boolean, const char* causality) {
  if (name.empty()) {
    return {};
  }
  const auto found = unit.variables.find(name);
  if (found == unit.variables.end()) {
    return fmt::format("has no Float64 or Boolean variable \"{}\" ({})", name, key);
  }
  const auto& variable = found->second;
  if (variable.is_boolean != is_boolean || variable.causality != causality) {
    return fmt::format("has \"{}\" ({}) as {} {}, not as {} {}", name, key,
                       variable.is_boolean ? "Boolean" : "Float64", variable.causality,
                       is_boolean ? "Boolean" : "Float64", causality);
  }
  return {};
}

struct Connection {
  ValueReference reference;
  std::size_t axis;
  double towbench_plant_input::*input = nullptr;
  double towbench_plant_output::*output = nullptr;
};

// What the unit said last, for the line that ends a run.
struct Said {
  std::string text;
};

void hear(void* environment, Status /*status*/, const char* /*category*/, const char* message) {
  static_cast<Said*>(environment)->text = message == nullptr ? "" : message;
}

class FmuInstance final : public LoadedPlant {
 public:
  FmuInstance(const FmuDescription& unit, const std::vector<FmuAxis>& axes,
              const fmi3::Functions& functions)
      : unit_(unit), axes_(axes), f_(functions) {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      connect(axes_[i], i);
    }
    values_.resize(std::max(inputs_.size(), outputs_.size()));
  }
  FmuInstance(const FmuInstance&) = delete;
  FmuInstance& operator=(const FmuInstance&) = delete;
  ~FmuInstance() override {
    if (instance_ != nullptr) {
      (void)f_.terminate(instance_);
      f_.free_instance(instance_);
    }
  }

  bool start(const std::string& resources, const std::vector<PlantAxis>& axes,
             const std::vector<FmuStart>& starts, std::string& why) {
    instance_ = f_.instantiate("plant", unit_.token.c_str(), resources.c_str(), false, false, false,
                               true, nullptr, 0, &said_, hear, nullptr);
    const bool good = instance_ != nullptr && set_starts(axes, starts) &&
                      taken(f_.enter_initialization(instance_, false, 0, 0.0, false, 0)) &&
                      taken(f_.exit_initialization(instance_));
    why = good ? "" : "does not start: " + (said_.text.empty() ? "no reason given" : said_.text);
    return good;
  }

  bool step(double until_s, const towbench_plant_input* inputs, towbench_plant_output* outputs,
            double& reached_s, char* message, std::size_t size) override {
    said_.text.clear();
    const bool good = set(inputs) && go_to(until_s) && get(outputs);
    reached_s = time_s_;
    if (!good) {
      fmt::format_to_n(message, size - 1, "{}", said_.text).out[0] = '\0';
    }
    return good;
  }

  std::size_t state_size() override {
    std::size_t size = 0;
    fmi3::State state = nullptr;
    if (unit_.serializes_state && taken(f_.get_state(instance_, &state))) {
      (void)f_.state_size(instance_, state, &size);
      (void)f_.free_state(instance_, &state);
      size += sizeof time_s_;
    }
    size_ = size;
    return size;
  }
  // The time first, then the unit's bytes.
  bool save(void* to) override {
    fmi3::State state = nullptr;
    auto* const bytes = static_cast<std::uint8_t*>(to);
    std::memcpy(bytes, &time_s_, sizeof time_s_);
    const bool good =
        taken(f_.get_state(instance_, &state)) &&
        taken(f_.serialize(instance_, state, bytes + sizeof time_s_, size_ - sizeof time_s_));
    return taken(f_.free_state(instance_, &state)) && good;
  }
  bool restore(const void* from) override {
    (void)state_size();
    const auto* const bytes = static_cast<const std::uint8_t*>(from);
    fmi3::State state = nullptr;
    std::memcpy(&time_s_, bytes, sizeof time_s_);
    return taken(
               f_.deserialize(instance_, bytes + sizeof time_s_, size_ - sizeof time_s_, &state)) &&
           taken(f_.set_state(instance_, state)) && taken(f_.free_state(instance_, &state));
  }

 private:
  static bool taken(Status status) { return status <= Status::kWarning; }

  void connect(const FmuAxis& axis, std::size_t index) {
    for (const auto& row : kInputs) {
      if (!(axis.*row.variable).empty()) {
        inputs_.push_back({unit_.variables.at(axis.*row.variable).reference, index, row.value});
        input_references_.push_back(inputs_.back().reference);
      }
    }
    for (const auto& row : kOutputs) {
      if (!(axis.*row.variable).empty()) {
        outputs_.push_back(
            {unit_.variables.at(axis.*row.variable).reference, index, nullptr, row.value});
        output_references_.push_back(outputs_.back().reference);
      }
    }
  }

  bool set_one(const std::string& name, double value) {
    const auto& variable = unit_.variables.at(name);
    const bool flag = value != 0;
    return taken(variable.is_boolean
                     ? f_.set_boolean(instance_, &variable.reference, 1, &flag, 1)
                     : f_.set_float64(instance_, &variable.reference, 1, &value, 1));
  }

  bool set_starts(const std::vector<PlantAxis>& axes, const std::vector<FmuStart>& starts) {
    bool good = true;
    for (const auto& start : starts) {
      good = good && set_one(start.name, start.value);
    }
    for (std::size_t i = 0; i < axes.size(); ++i) {
      good = good && (axes_[i].start_m.empty() || set_one(axes_[i].start_m, axes[i].start_m));
    }
    return good;
  }

  bool set(const towbench_plant_input* inputs) {
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      values_[i] = inputs[inputs_[i].axis].*inputs_[i].input;
    }
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      if (!axes_[i].enabled.empty() && !set_one(axes_[i].enabled, inputs[i].enabled)) {
        return false;
      }
    }
    return inputs_.empty() || taken(f_.set_float64(instance_, input_references_.data(),
                                                   inputs_.size(), values_.data(), inputs_.size()));
  }

  // A unit may return before the end of the step; it is asked for the rest, and must get on.
  bool go_to(double until_s) {
    for (int i = 0; i < kMostReturns && until_s - time_s_ > kSameTime_s; ++i) {
      bool event = false;
      bool ends = false;
      bool early = false;
      double last_s = time_s_;
      const auto status =
          f_.do_step(instance_, time_s_, until_s - time_s_, true, &event, &ends, &early, &last_s);
      if (!taken(status) || ends) {
        said_.text += ends ? "it asks for the end of the simulation" : "";
        return false;
      }
      const double reached_s = early ? last_s : until_s;
      if (!(reached_s > time_s_)) {
        said_.text = "it returns early and does not get on";
        return false;
      }
      time_s_ = reached_s;
    }
    time_s_ = std::fabs(until_s - time_s_) <= kSameTime_s ? until_s : time_s_;
    return true;
  }

  bool get(towbench_plant_output* outputs) {
    if (!taken(f_.get_float64(instance_, output_references_.data(), outputs_.size(), values_.data(),
                              outputs_.size()))) {
      return false;
    }
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      outputs[outputs_[i].axis].*outputs_[i].output = values_[i];
    }
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      if (axes_[i].motor_angle_rad.empty()) {
        outputs[i].motor_angle_rad = outputs[i].position_m / axes_[i].metres_per_motor_rad;
        outputs[i].motor_speed_rad_per_s =
            outputs[i].velocity_m_per_s / axes_[i].metres_per_motor_rad;
      }
    }
    return true;
  }

  FmuDescription unit_;
  std::vector<FmuAxis> axes_;
  fmi3::Functions f_;
  fmi3::Instance instance_ = nullptr;
  std::vector<Connection> inputs_;
  std::vector<Connection> outputs_;
  std::vector<ValueReference> input_references_;
  std::vector<ValueReference> output_references_;
  std::vector<double> values_;
  Said said_;
  double time_s_ = 0;
  std::size_t size_ = 0;  // of the state, with the time
};

}  // namespace

std::string misfit(const FmuDescription& unit, const FmuAxis& axis) {
  if (unit.fixed_step_s > 0) {
    const double steps = core::kPlantTick_s / unit.fixed_step_s;
    if (steps < 0.5 || std::fabs(steps - std::round(steps)) > 1e-6 * steps) {
      return fmt::format("has a step of {} s, which does not divide the bench's 100 us",
                         unit.fixed_step_s);
    }
  }
  for (const auto& row : kInputs) {
    if (auto wrong = misfit_of(unit, row.name, axis.*row.variable, false, "input");
        !wrong.empty()) {
      return wrong;
    }
  }
  for (const auto& row : kOutputs) {
    if (auto wrong = misfit_of(unit, row.name, axis.*row.variable, false, "output");
        !wrong.empty()) {
      return wrong;
    }
  }
  if (auto wrong = misfit_of(unit, "enabled", axis.enabled, true, "input"); !wrong.empty()) {
    return wrong;
  }
  return misfit_of(unit, "start_m", axis.start_m, false, "parameter");
}

std::string misfit(const FmuDescription& unit, const FmuStart& start) {
  const auto found = unit.variables.find(start.name);
  const bool is_boolean = found != unit.variables.end() && found->second.is_boolean;
  return misfit_of(unit, "parameters", start.name, is_boolean, "parameter");
}

std::unique_ptr<LoadedPlant> FmuBinary::load(const std::vector<PlantAxis>& axes,
                                             std::string& why) const {
  fmi3::Functions functions;
  const auto& unit = unit_->description();
  if (!load_fmu_functions(unit_->library(), unit.serializes_state, functions, why)) {
    return nullptr;
  }
  auto instance = std::make_unique<FmuInstance>(unit, axes_, functions);
  return instance->start(unit_->resources(), axes, starts_, why) ? std::move(instance) : nullptr;
}

}  // namespace towbench::harness
