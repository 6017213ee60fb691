#include "study/procedures/identified_plant.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "harness/fixtures/rig_fixture.h"

namespace towbench::study::procedures {
namespace {

using identify::Estimate;
using identify::Estimates;

class AxisWriter {
 public:
  AxisWriter(const Machine& machine, const Estimates& estimates, core::Axis axis)
      : plate_(machine.nameplate(axis)),
        belief_(machine.configuration().axes[axis]),
        estimates_(estimates),
        axis_(core::name_of(axis)) {}

  std::string text() {
    const auto& drive = belief_.drive;
    const auto& model = belief_.feed_forward;
    head("");
    estimated("inertia_kg_m2", "inertia_kg_m2", model.inertia_kg_m2);
    rotor();
    estimated("viscous_friction_Nm_s_per_rad", "viscous_friction_Nm_s_per_rad",
              model.viscous_friction_Nm_s_per_rad);
    const double lowest = write_coulomb(model.coulomb_friction_Nm);
    documented("gear_ratio", plate_.gear_ratio);
    documented("sprocket_radius_m", plate_.output_radius_m);
    estimated("torque_constant_Nm_per_A", "torque_constant_Nm_per_A",
              drive.torque_constant_Nm_per_A);
    estimated("amplifier_gain_A_per_V", "amplifier_gain_A_per_V", drive.amplifier_gain_A_per_V);
    documented("pwm_amplitude_V", plate_.pwm_amplitude_V);
    documented("current_limit_A", plate_.current_limit_A);
    text_ += fmt::format("encoder_counts_per_rev = {}\n",
                         static_cast<std::int64_t>(plate_.counts_per_turn));
    head(".winding");
    documented("resistance_ohm", plate_.resistance_ohm);
    documented("inductance_H", plate_.inductance_H);
    text_ += "choke_inductance_H = 0.0  # in the inductance above\n";
    friction(lowest);
    head(".elasticity");
    estimated("resonance_Hz", "transmission_resonance_Hz", 9.0);
    estimated("damping_ratio", "transmission_damping_ratio", 0.06);
    head(".hard_ends");
    believed("min_m", edge_m(belief_.ends.hard_min_count));
    believed("max_m", edge_m(belief_.ends.hard_max_count));
    ends();
    return text_;
  }

 private:
  void head(const std::string& table) { text_ += fmt::format("\n[axis.{}{}]\n", axis_, table); }
  void line(std::string_view key, double value, std::string_view source) {
    text_ +=
        fmt::format("{} = {{ value = {}, source = \"{}\" }}\n", key, toml_number(value), source);
  }
  // Where a count begins: position_m() is its middle.
  [[nodiscard]] double edge_m(std::int64_t count) const {
    return static_cast<double>(count) * belief_.m_per_count();
  }
  static std::string toml_number(double value) {
    auto text = fmt::format("{:.9g}", value);
    if (text.find_first_of(".e") == std::string::npos) {
      text += ".0";
    }
    return text;
  }
  void documented(std::string_view key, double value) { line(key, value, "data sheet"); }
  void believed(std::string_view key, double value) { line(key, value, "controller's belief"); }
  void estimated(std::string_view key, std::string_view quantity, double belief) {
    if (const auto* found = identify::find(estimates_, quantity, axis_)) {
      line(key, found->value,
           fmt::format("{}, 95 %: {:.5g} .. {:.5g}", found->procedure, found->low, found->high));
    } else {
      believed(key, belief);
    }
  }
  // In units of the torques found, where a swing has told it.
  void rotor() {
    if (identify::find(estimates_, "rotor_inertia_kg_m2", axis_) != nullptr) {
      estimated("rotor_inertia_kg_m2", "rotor_inertia_kg_m2", plate_.rotor_inertia_kg_m2);
    } else {
      documented("rotor_inertia_kg_m2", plate_.rotor_inertia_kg_m2);
    }
  }
  [[nodiscard]] std::vector<Estimate> map_of(std::string_view quantity) const {
    std::vector<Estimate> map;
    for (const auto& each : estimates_) {
      if (each.quantity == quantity && each.axis == axis_ && each.at) {
        map.push_back(each);
      }
    }
    std::sort(map.begin(), map.end(),
              [](const Estimate& a, const Estimate& b) { return *a.at < *b.at; });
    return map;
  }

  // What is the same everywhere is the machine's own; what is above it belongs to the place.
  double write_coulomb(double belief) {
    const auto map = map_of("coulomb_friction_Nm");
    if (map.empty()) {
      estimated("coulomb_friction_Nm", "coulomb_friction_Nm", belief);
      return 0;
    }
    const auto* common = identify::find(estimates_, "friction_common_Nm", axis_);
    const auto& lowest = *std::min_element(
        map.begin(), map.end(),
        [](const Estimate& one, const Estimate& other) { return one.value < other.value; });
    const double value = common != nullptr ? common->value : lowest.value;
    line("coulomb_friction_Nm", value,
         fmt::format("{}; the rest belongs to the place, below", lowest.procedure));
    return value;
  }

  void friction(double lowest_Nm) {
    head(".friction");
    const auto* excess = identify::find(estimates_, "stiction_excess_Nm", axis_);
    const auto* coulomb = identify::find(estimates_, "coulomb_friction_Nm", axis_);
    const double base = lowest_Nm > 0 || coulomb == nullptr ? lowest_Nm : coulomb->value;
    if (excess != nullptr && base > 0) {
      line("breakaway_Nm", base + std::max(0.0, excess->value), excess->procedure);
    } else {
      believed("breakaway_Nm", std::max(belief_.friction.breakaway_Nm, base));
    }
    estimated("stribeck_speed_rad_per_s", "stribeck_speed_rad_per_s",
              belief_.friction.stribeck_speed_rad_per_s);
    estimated("carriage_share", "friction_carriage_share", 0.65);
    const auto map = map_of("coulomb_friction_Nm");
    if (map.size() < 2) {
      return;
    }
    std::string places;
    std::string levels;
    for (const auto& each : map) {
      places += fmt::format("{}{}", places.empty() ? "" : ", ", toml_number(*each.at));
      levels += fmt::format("{}{}", levels.empty() ? "" : ", ",
                            toml_number(std::max(0.0, each.value - lowest_Nm)));
    }
    head(".friction.position");
    text_ += fmt::format("position_m = {{ value = [{}], source = \"{}\" }}\n", places,
                         map.front().procedure);
    text_ += fmt::format("friction_Nm = {{ value = [{}], source = \"{}\" }}\n", levels,
                         map.front().procedure);
  }

  void ends() {
    head(".hall_min");
    estimated("position_m", "hall_min_m", belief_.position_m(belief_.ends.hall_min_count));
    head(".hall_max");
    estimated("position_m", "hall_max_m", belief_.position_m(belief_.ends.hall_max_count));
  }

  const Nameplate& plate_;
  const bbmc::AxisConfiguration& belief_;
  const Estimates& estimates_;
  std::string_view axis_;
  std::string text_;
};

}  // namespace

std::string identified_plant(const Machine& machine, const Estimates& estimates) {
  std::string text;
  for (const auto axis : core::kPlanarAxes) {
    const bool studied = std::any_of(estimates.begin(), estimates.end(), [&](const Estimate& each) {
      return each.axis == core::name_of(axis);
    });
    if (studied && machine.nameplate(axis).exists) {
      text += AxisWriter(machine, estimates, axis).text();
    }
  }
  return text.empty() ? text
                      : "# Written by `towbench identify`. SI at the motor shaft.\nschema = 1\n"
                        "name = \"identified\"\n" +
                            text;
}

std::string contradiction(const std::string& plant) {
  std::string why;
  try {
    (void)harness::read_plant(harness::FixtureFile::parse(plant, "identified_plant.toml"));
    return why;
  } catch (const harness::FixtureError& error) {
    why = error.allowed();
  }
  // Each value that the reason names, with its source.
  std::string given;
  std::string table;
  std::istringstream lines(plant);
  for (std::string line; std::getline(lines, line);) {
    table = line.starts_with('[') ? line : table;
    const auto key = line.substr(0, line.find(" = "));
    if (key.size() < line.size() && why.find(key) != std::string::npos) {
      given += fmt::format("{} {} {}", given.empty() ? ": given" : ",", table, line);
    }
  }
  return why + given;
}

}  // namespace towbench::study::procedures
