#include "harness/new_machine/disagreement.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "core/axis.h"

namespace towbench::harness {
namespace {

constexpr double kTolerance = 0.01;

class Comparison {
 public:
  Comparison(std::string_view axis, std::vector<std::string>& found) : axis_(axis), found_(found) {}

  void add(std::string_view key, double rig, double controller, double scale) {
    if (std::fabs(rig - controller) > kTolerance * scale) {
      found_.push_back(fmt::format("axis.{}: {} is {:.6g} in the rig and {:.6g} in the controller",
                                   axis_, key, rig, controller));
    }
  }
  void add(std::string_view key, double rig, double controller) {
    add(key, rig, controller, std::max(std::fabs(rig), std::fabs(controller)));
  }

 private:
  std::string_view axis_;
  std::vector<std::string>& found_;
};

void compare_places(const emulator::RigAxisParameters& rig, const bbmc::AxisConfiguration& belief,
                    Comparison& all) {
  const auto& ends = rig.plant.hard_ends;
  const double travel_m = ends.max_m - ends.min_m;
  const auto place = [&](const char* key, bool fitted, double rig_m, std::int64_t count) {
    if (fitted) {
      all.add(key, rig_m, static_cast<double>(count) * belief.m_per_count(), travel_m);
    }
  };
  place("hard_ends.min_m (ends.hard_min_count)", ends.fitted, ends.min_m,
        belief.ends.hard_min_count);
  place("hard_ends.max_m (ends.hard_max_count)", ends.fitted, ends.max_m,
        belief.ends.hard_max_count);
  place("hall_min.position_m (ends.hall_min_count)", rig.hall_min.fitted, rig.hall_min.position_m,
        belief.ends.hall_min_count);
  place("hall_max.position_m (ends.hall_max_count)", rig.hall_max.fitted, rig.hall_max.position_m,
        belief.ends.hall_max_count);
}

void compare(const emulator::RigAxisParameters& rig, const bbmc::AxisConfiguration& belief,
             Comparison& all) {
  const auto& plant = rig.plant;
  all.add("way of the load a motor radian", plant.output_radius_m / plant.gear_ratio,
          belief.metres_per_motor_rad());
  all.add("encoder_counts_per_rev", static_cast<double>(rig.encoder.counts_per_turn),
          static_cast<double>(belief.encoder_counts_per_rev));
  all.add("torque_constant_Nm_per_A", plant.torque_constant_Nm_per_A,
          belief.drive.torque_constant_Nm_per_A);
  all.add("amplifier_gain_A_per_V", plant.amplifier_gain_A_per_V,
          belief.drive.amplifier_gain_A_per_V);
  all.add("pwm_amplitude_V", rig.command.pwm_amplitude_V, belief.drive.pwm_amplitude_V);
  all.add("current_limit_A", plant.current_limit_A, belief.drive.current_limit_A);
  all.add("inertia_kg_m2 (braking.inertia_kg_m2)", plant.inertia_kg_m2,
          belief.braking.inertia_kg_m2);
  compare_places(rig, belief, all);
}

}  // namespace

std::vector<std::string> disagreements(const emulator::RigParameters& rig,
                                       const bbmc::Configuration& controller) {
  std::vector<std::string> found;
  for (const auto axis : core::kPlanarAxes) {
    if (rig.axes[axis].exists && controller.axes[axis].exists) {
      Comparison all(core::name_of(axis), found);
      compare(rig.axes[axis], controller.axes[axis], all);
    }
  }
  return found;
}

}  // namespace towbench::harness
