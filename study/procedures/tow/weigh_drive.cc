#include "study/procedures/tow/weigh_drive.h"

#include <algorithm>

#include <fmt/format.h>

#include "study/identify/tow/transmission_swing.h"
#include "study/procedures/tow/feasibility.h"

namespace towbench::study::procedures {
namespace {

constexpr double kWeighTyped_s = 1.0;  // the motion is asked for then
constexpr double kWait_s = 0.5;
constexpr double kWeighRamp_s = 0.8;
constexpr double kWeighSmooth_s = 0.243;
constexpr double kSettle_s = 2.0;
constexpr double kOnset_s = 0.03;  // the sensor has followed the weight

struct Plan {
  double speed_m_per_s;
  double distance_m;
  identify::PullTimes times;
  double pull_s;
};

// First third of the steady part without the weight, the rest with it.
Plan plan_of(core::Axis axis, const WeighSettings& settings) {
  Plan plan{};
  plan.speed_m_per_s = axis == core::Axis::kY ? settings.speed_y_m_per_s : settings.speed_x_m_per_s;
  plan.distance_m = axis == core::Axis::kY ? settings.distance_y_m : settings.distance_x_m;
  const double start_s = kWeighTyped_s + kWait_s + kWeighRamp_s + kWeighSmooth_s;
  const double steady_s = plan.distance_m / plan.speed_m_per_s - kWeighRamp_s - kWeighSmooth_s;
  plan.pull_s = start_s + steady_s / 3;
  plan.times = {.before_from_s = start_s + kSettle_s / 2,
                .before_to_s = plan.pull_s - 0.05,
                .pulled_from_s = plan.pull_s + kSettle_s,
                .pulled_to_s = start_s + steady_s - 0.05};
  return plan;
}

Conversation conversation(const Machine& machine, core::Axis axis, const WeighSettings& settings,
                          bool pulled) {
  const auto plan = plan_of(axis, settings);
  Conversation talk;
  talk.name =
      fmt::format("weighing {}, {}", core::name_of(axis), pulled ? "weight on" : "no weight");
  talk.start_m[core::Axis::kY] = settings.start_y_m;
  talk.start_m[core::Axis::kX] = settings.start_x_m;
  talk.steps = declare_position(talk, machine);
  auto step =
      move(fmt::format("run -trapez {} --distance {:.4f}m --speed {:.4f}m/s "
                       "--acceleration {:.3f}s --smooth {:.3f}s --wait {:.3f}s",
                       core::name_of(axis), plan.distance_m, plan.speed_m_per_s, kWeighRamp_s,
                       kWeighSmooth_s, kWait_s));
  step.at_s = kWeighTyped_s;
  talk.steps.push_back(step);
  if (pulled) {
    const double end_s = plan.times.pulled_to_s + 0.02;
    for (const auto& [time_s, force_N] :
         {std::pair{plan.pull_s, -settings.weight_N}, std::pair{end_s, 0.0}}) {
      talk.events.push_back({.time_ns = core::nanoseconds(time_s),
                             .kind = emulator::ScheduledEventKind::kPushCarriage,
                             .axis = axis,
                             .value = force_N});
    }
  }
  talk.limit_s = 200;
  return talk;
}

// Behind the transmission, by the controller's belief of the inertia.
double moved_mass_kg(const Machine& machine, core::Axis axis) {
  const auto& plate = machine.nameplate(axis);
  const double believed = machine.configuration().axes[axis].feed_forward.inertia_kg_m2;
  const double r = plate.metres_per_motor_rad();
  return std::max(believed - plate.rotor_inertia_kg_m2, 0.1 * believed) / (r * r);
}

}  // namespace

bbmc::Configuration expecting_load(const Machine& machine, double load_N) {
  auto configuration = machine.configuration();
  for (const auto axis : core::kPlanarAxes) {
    configuration.axes[axis].plausibility.external_load_N = load_N;
  }
  return configuration;
}

std::string why_not(const Machine& machine, core::Axis axis, const WeighSettings& settings) {
  const auto plan = plan_of(axis, settings);
  const double start_m = axis == core::Axis::kY ? settings.start_y_m : settings.start_x_m;
  constexpr double kSteady_s = 6.0;
  for (auto why :
       {no_axis(machine, axis), no_force_sensor(machine),
        no_travel(machine, axis, start_m, start_m + plan.distance_m),
        too_fast(machine, axis, plan.speed_m_per_s, 0.0, settings.weight_N),
        too_short(plan.distance_m, plan.speed_m_per_s, kWeighRamp_s, kWeighSmooth_s, kSteady_s)}) {
    if (!why.empty()) {
      return why;
    }
  }
  return {};
}

WeighedDrive weigh_drive(const Machine& machine, core::Axis axis, const WeighSettings& settings) {
  const auto configuration = expecting_load(machine, 2 * settings.weight_N);
  WeighedDrive found;
  const auto pulled = machine.play(conversation(machine, axis, settings, true), configuration);
  const auto plain = machine.play(conversation(machine, axis, settings, false), configuration);
  for (const auto* run : {&pulled, &plain}) {
    if (!run->trouble.empty()) {
      found.trouble = "weighing the drive: " + run->trouble;
      return found;
    }
  }
  const auto scale = identify::drive_scale(pulled, plain, axis, plan_of(axis, settings).times);
  if (!scale) {
    found.trouble = "weighing the drive: the weight moved neither force nor duty clearly";
    return found;
  }
  found.scale = *scale;
  const double pull_s = plan_of(axis, settings).pull_s;
  const auto swing =
      identify::transmission_swing(pulled, axis, pull_s + kOnset_s, pull_s + kSettle_s);
  if (!swing) {
    found.trouble = "weighing the drive: the carriage does not swing where the weight sets in";
    return found;
  }
  found.transmission = {swing->rate_rad_per_s, moved_mass_kg(machine, axis),
                        swing->standard_error / swing->rate_rad_per_s};
  return found;
}

}  // namespace towbench::study::procedures
