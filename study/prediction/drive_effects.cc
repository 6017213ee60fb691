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

std::vector<Scales> stall_levels(const Context& c) {
  return c.stated.no_load_speed_m_per_s <= 0 || c.stated.force_limit_N <= 0
             ? std::vector<Scales>{}
             : multiples({0.2, 0.3, 0.45, 0.6, 0.8}, c.stated.force_limit_N);
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
// At standstill all of the voltage lies at the winding, whose time constant stays.
PlantValues winding_values(const Parameters& p, const StatedPlant& stated) {
  const double ohm = stated.voltage_limit_V * stated.torque_constant_Nm_per_A /
                     (stated.metres_per_motor_rad * p[Key::kStallLevel]);
  return {ohm, ohm * stated.winding_s - stated.choke_H};
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
                     .scales = {Key::kStallLevel},
                     .scale_names = {"stall_N"},
                     .positive = true,
                     .whole = 1,
                     .grid = stall_levels,
                     .set = set_scale<Key::kStallLevel>,
                     .step = whole_step,
                     .plant_keys = {"winding.resistance_ohm", "winding.inductance_H"},
                     .plant_values = winding_values});
}

}  // namespace towbench::study::diagnose
