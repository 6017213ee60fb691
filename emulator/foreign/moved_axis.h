// What moves an axis of the rig: the built-in equations, or its share of a foreign plant.
#pragma once

#include <variant>

#include "emulator/foreign/foreign_axis.h"
#include "emulator/plant/axis_plant.h"

namespace towbench::emulator {

class MovedAxis {
 public:
  // `at_start`: what the foreign plant says at time 0; null for the built-in one.
  MovedAxis(const AxisParameters& axis, double start_m, const ForeignOutput* at_start)
      : plant_(at_start == nullptr ? Plant(std::in_place_type<AxisPlant>, axis, start_m)
                                   : Plant(std::in_place_type<ForeignAxis>, axis, *at_start)) {}

  // For a foreign plant only.
  TOWBENCH_REALTIME [[nodiscard]] ForeignInput foreign_input(const AxisInput& input) noexcept {
    return std::get<ForeignAxis>(plant_).input_for(input);
  }
  // `output` is of the foreign plant's step.
  TOWBENCH_REALTIME void step(const AxisInput& input, const ForeignOutput& output,
                              MotionSegments& segments) noexcept {
    if (auto* const built_in = std::get_if<AxisPlant>(&plant_)) {
      built_in->step(input, segments);
    } else {
      std::get<ForeignAxis>(plant_).follow(output, segments);
    }
  }
  // A foreign plant's transmission is its own: 0, and nothing happens.
  TOWBENCH_REALTIME [[nodiscard]] double skip_tooth(double by_m) noexcept {
    auto* const built_in = std::get_if<AxisPlant>(&plant_);
    return built_in != nullptr ? built_in->skip_tooth(by_m) : 0.0;
  }

  [[nodiscard]] AxisState state() const noexcept {
    return std::visit([](const auto& plant) { return plant.state(); }, plant_);
  }
  [[nodiscard]] const HardEndContact& contact() const noexcept {
    return std::visit(
        [](const auto& plant) -> const auto& { return plant.contact(); }, plant_);
  }
  [[nodiscard]] AxisForces forces() const noexcept {
    return std::visit([](const auto& plant) { return plant.forces(); }, plant_);
  }

 private:
  using Plant = std::variant<AxisPlant, ForeignAxis>;
  Plant plant_;
};

}  // namespace towbench::emulator
