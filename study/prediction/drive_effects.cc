// Amplifier, command path and supply: what happens between the logged command and the force.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "study/prediction/effect_steps.h"

namespace towbench::study::diagnose {
namespace {

// A gain, or counts, off by more than that is a wrong unit.
constexpr double kLeastShare = 0.03;
constexpr double kMostShare = 0.4;

double time_step(const Context& c) {
  return 0.2 * c.period_s;
}

// In the span of mass and friction, but for what the model states beyond them.
std::vector<Scales> where_more_is_stated(const Context& c) {
  const NominalModel& m = c.stated;
  const bool more = m.elastic() || !m.friction_at_m.empty() || m.breakaway_excess_N != 0 ||
                    m.terms[Key::kGravitySine] != 0 || m.terms[Key::kGravityCosine] != 0;
  return more ? std::vector<Scales>{{}} : std::vector<Scales>{};
}

std::vector<Scales> clip_levels(const Context& c) {
  return multiples({0.1, 0.15, 0.22, 0.3, 0.45, 0.6, 0.75, 0.9}, c.input_max_N);
}

// Force at standstill and the speed without load. A speed far above those of the log is a clip.
std::vector<Scales> stall_lines(const Context& c) {
  std::vector<double> speeds = {1.15 * c.top_speed_m_per_s, 1.5 * c.top_speed_m_per_s,
                                2.2 * c.top_speed_m_per_s};
  if (c.stated.no_load_speed_m_per_s > 0) speeds.push_back(c.stated.no_load_speed_m_per_s);
  std::vector<Scales> grid;
  for (const double level : {0.3, 0.45, 0.6, 0.8, 1.1, 1.5}) {
    for (const double speed : speeds) grid.push_back({level * c.input_max_N, speed});
  }
  return grid;
}

void set_stall_line(Parameters& p, const Context& /*c*/, std::span<const double> scales) {
  p[Key::kStallLevel] = scales[0];
  p[Key::kStallSpeed] = scales[1];
}

PlantValues gain_values(const Parameters& p, const StatedPlant& stated) {
  return {stated.amplifier_gain_A_per_V * (1 - p[Key::kGainLoss])};
}
// Four counts a line.
PlantValues count_values(const Parameters& p, const StatedPlant& stated) {
  return {4 * std::round(stated.counts_per_turn * (1 - p[Key::kCountLoss]) / 4)};
}
PlantValues current_limit_values(const Parameters& p, const StatedPlant& stated) {
  return {p[Key::kClipLevel] * stated.metres_per_motor_rad / stated.torque_constant_Nm_per_A};
}
// Without load all of the voltage is back-EMF, at standstill all of it lies at the winding, whose
// time constant stays. Empty where the file states no motor.
PlantValues voltage_values(const Parameters& p, const StatedPlant& stated) {
  if (stated.model.no_load_speed_m_per_s <= 0) return {};
  const double volt_s = stated.torque_constant_Nm_per_A / stated.metres_per_motor_rad;
  const double limit_V =
      std::min(p[Key::kStallSpeed] * volt_s, stated.voltage_limit_V / stated.voltage_limit_ratio);
  const double ohm = limit_V * volt_s / p[Key::kStallLevel];
  return {ohm, ohm * stated.winding_s - stated.choke_H,
          limit_V / stated.voltage_limit_V * stated.voltage_limit_ratio};
}

}  // namespace

void add_drive_effects(std::vector<Effect>& library) {
  const std::string brisk = "fast accelerations";
  library.push_back({.name = "transport_delay",
                     .cause = "a delay between command and force",
                     .needs = brisk,
                     .law = "u(t - T)",
                     .source = "dead time",
                     .amplitudes = {Key::kDelay},
                     .amplitude_names = {"delay_s"},
                     .positive = true,
                     .grid = no_scale,
                     .set = set_nothing,
                     .step = time_step});
  library.push_back({.name = "current_loop_lag",
                     .cause = "a first-order lag between command and force",
                     .needs = brisk,
                     .law = "T F' = u - F",
                     .source = "3.3.1: the current loop as one lag",
                     .amplitudes = {Key::kLag},
                     .amplitude_names = {"time_constant_s"},
                     .positive = true,
                     .grid = no_scale,
                     .set = set_nothing,
                     .step = time_step});
  library.push_back({.name = "amplifier_gain",
                     .cause = "an amplifier gain other than stated",
                     .needs = "a known mass or force, or a force channel",
                     .law = "(1 - k) u",
                     .source = "Table 7.1",
                     .amplitudes = {Key::kGainLoss},
                     .amplitude_names = {"relative_loss_ratio"},
                     .least = kLeastShare,
                     .most = kMostShare,
                     .grid = where_more_is_stated,
                     .set = set_nothing,
                     .step = share_step,
                     .plant_keys = {"amplifier_gain_A_per_V"},
                     .plant_values = gain_values});
  library.push_back({.name = "encoder_count_loss",
                     .cause = "an encoder that loses a share of its counts",
                     .needs = "a known distance, or the index pulse",
                     .law = "reads (1 - k) x",
                     .source = "assumed",
                     .amplitudes = {Key::kCountLoss},
                     .amplitude_names = {"lost_share_ratio"},
                     .least = kLeastShare,
                     .most = kMostShare,
                     .grid = where_more_is_stated,
                     .set = set_nothing,
                     .step = share_step,
                     .plant_keys = {"encoder_counts_per_rev"},
                     .plant_values = count_values});
  library.push_back({.name = "amplifier_deadband",
                     .cause = "an amplifier that ignores small commands",
                     .needs = "coasting and braking as well as driving",
                     .law = "sgn(u) max(|u| - d, 0)",
                     .source = "dead zone",
                     .amplitudes = {Key::kDeadband},
                     .amplitude_names = {"deadband_N"},
                     .positive = true,
                     .grid = no_scale,
                     .set = set_nothing,
                     .step = force_step});
  library.push_back({.name = "command_saturation",
                     .cause = "an amplifier that clips below the logged command",
                     .needs = "commands up to the limit",
                     .law = "u limited to +-F_max",
                     .source = "Table 7.1, I_max",
                     .amplitudes = {Key::kClipShare},
                     .amplitude_names = {"clipped_share_ratio"},
                     .scales = {Key::kClipLevel},
                     .scale_names = {"level_N"},
                     .positive = true,
                     .whole = 1,
                     .grid = clip_levels,
                     .set = set_scale<Key::kClipLevel>,
                     .step = whole_step,
                     .plant_keys = {"current_limit_A"},
                     .plant_values = current_limit_values});
  library.push_back({.name = "voltage_saturation",
                     .cause = "a supply too low for the force at speed",
                     .needs = "large force at high speed",
                     .law = "u limited to F_s (1 - v/v_0)",
                     .source = "(3.13): supply less back-EMF",
                     .amplitudes = {Key::kStallShare},
                     .amplitude_names = {"clipped_share_ratio"},
                     .scales = {Key::kStallLevel, Key::kStallSpeed},
                     .scale_names = {"stall_N", "no_load_m_per_s"},
                     .positive = true,
                     .whole = 1,
                     .grid = stall_lines,
                     .set = set_stall_line,
                     .step = whole_step,
                     .plant_keys = {"winding.resistance_ohm", "winding.inductance_H",
                                    "amplifier.output_limit_ratio"},
                     .plant_values = voltage_values});
}

}  // namespace towbench::study::diagnose
