#include "harness/new_machine/machine_files.h"

#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "harness/new_machine/derived_machine.h"

namespace towbench::harness {
namespace {

constexpr double kHallShare = 0.025;  // of the stroke, from each stop
constexpr double kSoftShare = 0.05;   // likewise: no motion is planned beyond

class Toml {
 public:
  explicit Toml(const MachineData& data, std::string_view what) {
    text_ = fmt::format("# {} of {}, written by towbench new-machine.\nschema = 1\nname = \"{}\"\n",
                        what, data.name, data.name);
  }
  Toml& table(std::string_view name) {
    text_ += fmt::format("\n[{}]\n", name);
    return *this;
  }
  Toml& line(std::string_view text) {
    text_ += fmt::format("{}\n", text);
    return *this;
  }
  Toml& number(std::string_view key, double value, std::string_view source) {
    text_ += fmt::format("{} = {{ value = {:.9}, source = \"{}\" }}\n", key, value, source);
    return *this;
  }
  Toml& whole(std::string_view key, double value) {
    text_ += fmt::format("{} = {}\n", key, static_cast<std::int64_t>(std::llround(value)));
    return *this;
  }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void write_transmission(Toml& file, const MachineData& data) {
  file.table("axis.y.transmission").line(fmt::format("kind = \"{}\"", data.kind));
  file.number("gear_ratio", data[Number::kGearRatio], "given");
  if (data.kind == "screw") {
    file.number("lead_m", data[Number::kLead], "given");
  } else {
    const char* const key = data.kind == "belt"   ? "pulley_radius_m"
                            : data.kind == "rack" ? "pinion_radius_m"
                                                  : "sprocket_radius_m";
    file.number(key, data[Number::kRadius], "given");
  }
}

std::string plant_text(const MachineData& data, const DerivedMachine& m) {
  Toml file(data, "Plant");
  file.table("axis.y");
  file.number("inertia_kg_m2", m.inertia_kg_m2, "rotor + mass (lead / 2 pi gear_ratio)^2");
  file.number("rotor_inertia_kg_m2", data[Number::kRotorInertia], "given");
  file.number("viscous_friction_Nm_s_per_rad", m.viscous_Nm_s_per_rad,
              "assumed: doubles the friction at top speed");
  file.number("coulomb_friction_Nm", m.coulomb_Nm, "friction at the load, as given or assumed");
  file.number("torque_constant_Nm_per_A", data[Number::kTorqueConstant], "given");
  file.number("amplifier_gain_A_per_V", data[Number::kAmplifierGain], "given");
  file.number("pwm_amplitude_V", kFullDuty_V, "assumed");
  file.number("current_limit_A", data[Number::kCurrentLimit], "given");
  file.whole("encoder_counts_per_rev", 4.0 * data[Number::kEncoderLines]);
  write_transmission(file, data);
  file.table("axis.y.winding");
  file.number("resistance_ohm", data[Number::kResistance], "given");
  file.number("inductance_H", 0.3e-3 * data[Number::kResistance], "assumed: 0.3 ms");
  file.number("choke_inductance_H", 0.0, "assumed");
  file.table("axis.y.friction");
  file.number("breakaway_Nm", m.breakaway_Nm, "assumed: 1.5 times Coulomb friction");
  file.table("axis.y.encoder");
  file.number("max_channel_Hz", kLargestChannel_Hz, "assumed");
  file.table("axis.y.hard_ends");
  file.number("min_m", 0.0, "stroke");
  file.number("max_m", data[Number::kStroke], "stroke");
  file.number("stiffness_N_per_m", m.stop_stiffness_N_per_m,
              "assumed: 2 mm deep from the speed limit");
  file.number("damping_N_s_per_m", m.stop_damping_N_s_per_m, "assumed: half of critical");
  file.table("supply");
  file.number("voltage_V", data[Number::kSupply], "given");
  file.number("over_current_A", 2.0 * data[Number::kCurrentLimit], "assumed");
  file.number("cut_out_V", 0.8 * data[Number::kSupply], "assumed");
  return file.take();
}

void write_switch(Toml& file, const MachineData& data, std::string_view end, double position_m) {
  file.table(fmt::format("axis.y.hall_{}", end));
  if (data.switches == "both" || data.switches == end) {
    file.number("position_m", position_m, "assumed: 2.5 % of the stroke before the stop");
  } else {
    file.line("fitted = false");
  }
}

std::string rig_text(const MachineData& data, const DerivedMachine& m) {
  const double stroke_m = data[Number::kStroke];
  Toml file(data, "Rig");
  file.line("plants = [\"plant.toml\"]").table("axis.y");
  file.number("start_m", m.trial_start_m, "30 % of the stroke");
  write_switch(file, data, "min", kHallShare * stroke_m);
  write_switch(file, data, "max", (1.0 - kHallShare) * stroke_m);
  return file.take();
}

std::string controller_text(const MachineData& data, const DerivedMachine& m) {
  const double stroke_counts = data[Number::kStroke] * m.counts_per_m;
  const std::string poles = fmt::format("three poles at {} Hz", data[Number::kBandwidth]);
  Toml file(data, "What BBMC believes");
  file.line("control_rate_Hz = 1000.0").table("axis.x").line("exists = false").table("axis.y");
  file.whole("encoder_counts_per_rev", 4.0 * data[Number::kEncoderLines]);
  file.number("speed_limit_m_per_s", m.speed_limit_m_per_s,
              "0.8 of the speed at the voltage limit");
  write_transmission(file, data);
  file.table("axis.y.gains");
  file.number("proportional_Nm_per_rad", m.proportional_Nm_per_rad, poles);
  file.number("integral_Nm_per_rad_s", m.integral_Nm_per_rad_s, poles);
  file.number("derivative_Nm_s_per_rad", m.derivative_Nm_s_per_rad, poles);
  file.table("axis.y.drive");
  file.number("torque_constant_Nm_per_A", data[Number::kTorqueConstant], "given");
  file.number("amplifier_gain_A_per_V", data[Number::kAmplifierGain], "given");
  file.number("pwm_amplitude_V", kFullDuty_V, "assumed");
  file.number("current_limit_A", data[Number::kCurrentLimit], "given");
  file.table("axis.y.ends").line("# counts from the min stop");
  file.whole("hard_min_count", 0).whole("hard_max_count", stroke_counts);
  file.whole("hall_min_count", kHallShare * stroke_counts);
  file.whole("hall_max_count", (1.0 - kHallShare) * stroke_counts);
  file.whole("soft_min_count", kSoftShare * stroke_counts);
  file.whole("soft_max_count", (1.0 - kSoftShare) * stroke_counts);
  file.table("axis.y.braking");
  file.number("inertia_kg_m2", m.inertia_kg_m2, "as the plant");
  file.number("rotor_inertia_kg_m2", data[Number::kRotorInertia], "given");
  file.number("held_motor_chain_Hz", 200.0, "assumed: as good as rigid");
  file.number("gear_torque_limit_Nm", m.torque_Nm * data[Number::kGearRatio],
              "assumed: bears what the motor gives");
  file.number("speed_gain_Nm_s_per_rad", m.derivative_Nm_s_per_rad, "as the loop");
  file.table("axis.y.plausibility");
  file.number("worst_breakaway_Nm", 1.5 * m.breakaway_Nm + 0.01 * m.torque_Nm, "assumed");
  file.table("axis.y.homing");
  file.number("carriage_friction_Nm", m.breakaway_Nm, "as the plant");
  return file.take();
}

std::string experiment_text(const MachineData& data, const DerivedMachine& m) {
  Toml file(data, "A first motion");
  file.line("rig = \"rig.toml\"\ncontroller = \"controller.toml\"\nduration_limit_s = 120.0");
  file.table("[console]")
      .line(fmt::format("send = \"reset poscalib y {:.6g}m\"\nexpect = \"ok\"", m.trial_start_m));
  file.table("[console]")
      .line(
          fmt::format("send = \"run -trapez y --distance {:.6g}m --speed {:.4g}m/s --acceleration "
                      "{:.3g}s\"\nexpect = \"done\"\nwait = \"idle\"\ntimeout_s = 100.0",
                      m.trial_distance_m, m.trial_speed_m_per_s, m.trial_ramp_s));
  file.table("[budget]")
      .line(fmt::format("metric = \"y_tracking_error_peak_m\"\nmax = {:.4g}\n"
                        "source = \"what inertia and friction leave under K_P alone\"",
                        m.trial_error_m));
  file.table("[budget]")
      .line(fmt::format("metric = \"y_carriage_travel_m\"\nmin = {:.6g}\nmax = {:.6g}\n"
                        "source = \"the way asked for\"",
                        0.99 * m.trial_distance_m, 1.01 * m.trial_distance_m));
  return file.take();
}

}  // namespace

std::vector<MachineFile> files_of(const MachineData& data) {
  const DerivedMachine machine = derive(data);
  return {{"plant.toml", plant_text(data, machine)},
          {"rig.toml", rig_text(data, machine)},
          {"controller.toml", controller_text(data, machine)},
          {"experiment.toml", experiment_text(data, machine)}};
}

}  // namespace towbench::harness
