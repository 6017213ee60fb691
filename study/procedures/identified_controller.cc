#include "study/procedures/identified_controller.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace towbench::study::procedures {
namespace {

using identify::Estimate;
using identify::Estimates;

class AxisSetUp {
 public:
  AxisSetUp(bbmc::AxisConfiguration& axis, const Estimates& estimates, core::Axis which,
            harness::SourcesByKey& sources)
      : axis_(axis), estimates_(estimates), name_(core::name_of(which)), sources_(sources) {}

  void apply() {
    take("torque_constant_Nm_per_A", axis_.drive.torque_constant_Nm_per_A,
         "drive.torque_constant_Nm_per_A");
    take("amplifier_gain_A_per_V", axis_.drive.amplifier_gain_A_per_V,
         "drive.amplifier_gain_A_per_V");
    take("saturation_speed_m_per_s", axis_.speed_limit_m_per_s, "speed_limit_m_per_s");
    set_inertia();
    set_friction();
    set_ends();
  }

 private:
  void say(const std::string& key, const std::string& from) {
    sources_[fmt::format("axis.{}.{}", name_, key)] = from;
  }
  [[nodiscard]] const Estimate* find(std::string_view quantity) const {
    const Estimate* last = identify::find(estimates_, quantity, name_);
    for (const auto& each : estimates_) {
      if (last == nullptr && each.quantity == quantity && each.axis == name_) {
        last = &each;  // of a map with one point
      }
    }
    return last;
  }
  void take(std::string_view quantity, double& field, const char* key) {
    if (const auto* found = find(quantity)) {
      field = found->value;
      say(key, found->procedure);
    }
  }

  void set_inertia() {
    const auto* inertia = find("inertia_kg_m2");
    const auto* transmission = find("transmission_resonance_Hz");
    if (inertia == nullptr || inertia->value <= axis_.braking.rotor_inertia_kg_m2) {
      return;
    }
    const double ratio = inertia->value / axis_.feed_forward.inertia_kg_m2;
    axis_.gains.proportional_Nm_per_rad *= ratio;
    axis_.gains.integral_Nm_per_rad_s *= ratio;
    axis_.gains.derivative_Nm_s_per_rad *= ratio;
    for (const char* gain :
         {"proportional_Nm_per_rad", "integral_Nm_per_rad_s", "derivative_Nm_s_per_rad"}) {
      say(fmt::format("gains.{}", gain), "times identified over believed inertia");
    }
    take("inertia_kg_m2", axis_.feed_forward.inertia_kg_m2, "feed_forward.inertia_kg_m2");
    take("inertia_kg_m2", axis_.braking.inertia_kg_m2, "braking.inertia_kg_m2");
    auto& rotor_kg_m2 = axis_.braking.rotor_inertia_kg_m2;
    if (const auto* rotor = find("rotor_inertia_kg_m2");
        rotor != nullptr && rotor->value < inertia->value) {
      take("rotor_inertia_kg_m2", rotor_kg_m2, "braking.rotor_inertia_kg_m2");
      take("rotor_inertia_kg_m2", axis_.disturbance_observer.inertia_kg_m2,
           "disturbance_observer.inertia_kg_m2");
    }
    if (transmission != nullptr) {
      // From the free-free mode to the carriage on a held motor.
      axis_.braking.held_motor_chain_Hz =
          transmission->value * std::sqrt(rotor_kg_m2 / inertia->value);
      say("braking.held_motor_chain_Hz", transmission->procedure + ", motor held");
    }
  }

  // By place; of the whole axis where no place is told.
  [[nodiscard]] std::vector<const Estimate*> coulomb() const {
    std::vector<const Estimate*> map;
    for (const auto& each : estimates_) {
      if (each.quantity == "coulomb_friction_Nm" && each.axis == name_) {
        map.push_back(&each);
      }
    }
    return map;
  }

  void set_friction() {
    take("viscous_friction_Nm_s_per_rad", axis_.feed_forward.viscous_friction_Nm_s_per_rad,
         "feed_forward.viscous_friction_Nm_s_per_rad");
    take("viscous_friction_Nm_s_per_rad", axis_.friction.viscous_friction_Nm_s_per_rad,
         "friction.viscous_friction_Nm_s_per_rad");
    take("stribeck_speed_rad_per_s", axis_.friction.stribeck_speed_rad_per_s,
         "friction.stribeck_speed_rad_per_s");
    const auto map = coulomb();
    if (map.empty()) {
      return;
    }
    double mean_Nm = 0;
    double worst_Nm = 0;
    double least_Nm = map.front()->value;
    for (const auto* each : map) {
      mean_Nm += each->value / static_cast<double>(map.size());
      worst_Nm = std::max(worst_Nm, each->high);
      least_Nm = std::min(least_Nm, each->value);
    }
    const auto& procedure = map.front()->procedure;
    axis_.feed_forward.coulomb_friction_Nm = mean_Nm;
    axis_.friction.coulomb_friction_Nm = mean_Nm;
    say("feed_forward.coulomb_friction_Nm", procedure + ", mean over places");
    say("friction.coulomb_friction_Nm", procedure + ", mean over places");
    const auto* excess = find("stiction_excess_Nm");
    if (excess == nullptr) {
      return;
    }
    const double excess_Nm = std::max(0.0, excess->value);
    const double breakaway_Nm = mean_Nm + excess_Nm;
    axis_.friction.breakaway_Nm = breakaway_Nm;
    say("friction.breakaway_Nm", procedure + ", mean over places");
    axis_.plausibility.worst_breakaway_Nm = worst_Nm + std::max(0.0, excess->high);
    say("plausibility.worst_breakaway_Nm", procedure + ", most over places, upper ends");
    axis_.disturbance_observer.limit_Nm = 2 * breakaway_Nm;
    say("disturbance_observer.limit_Nm", procedure + ", twice break-away");
    if (const auto* share = find("friction_carriage_share")) {
      axis_.chain.carriage_friction_Nm = share->value * breakaway_Nm;
      say("chain.carriage_friction_Nm", procedure + ", the carriage's share of break-away");
      // Homing takes the motor's own friction at the ends to be S less this: S is a mean.
      const auto* common = find("friction_common_Nm");
      const double at_ends_Nm = (common != nullptr ? common->value : least_Nm) + excess_Nm;
      axis_.homing.carriage_friction_Nm = breakaway_Nm - (1 - share->value) * at_ends_Nm;
      say("homing.carriage_friction_Nm", procedure + ", less the motor's own at the ends");
    }
  }

  void set_ends() {
    const auto* distance = find("hall_distance_m");
    if (distance == nullptr) {
      return;
    }
    auto& ends = axis_.ends;
    const auto hall_max = ends.hall_min_count + std::llround(distance->value / axis_.m_per_count());
    const auto moved = hall_max - ends.hall_max_count;
    for (auto* each : {&ends.hall_max_count, &ends.hard_max_count, &ends.soft_max_count}) {
      *each += moved;
    }
    for (const char* key : {"hall_max_count", "hard_max_count", "soft_max_count"}) {
      say(fmt::format("ends.{}", key), distance->procedure);
    }
  }

  bbmc::AxisConfiguration& axis_;
  const Estimates& estimates_;
  std::string_view name_;
  harness::SourcesByKey& sources_;
};

}  // namespace

SetUpController set_up_controller(const bbmc::Configuration& before, const Machine& machine,
                                  const Estimates& estimates) {
  SetUpController made{.configuration = before, .sources = {}};
  for (const auto axis : core::kPlanarAxes) {
    if (machine.nameplate(axis).exists) {
      AxisSetUp(made.configuration.axes[axis], estimates, axis, made.sources).apply();
    }
  }
  return made;
}

std::string identified_controller(const Machine& machine, const Estimates& estimates) {
  const auto made = set_up_controller(machine.configuration(), machine, estimates);
  return made.sources.empty()
             ? std::string{}
             : "# Written by `towbench identify`: what BBMC believes is what was found.\n" +
                   harness::controller_text(made.configuration, "identified", made.sources);
}

}  // namespace towbench::study::procedures
