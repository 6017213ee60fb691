#include "study/procedures/tow/straight_tow.h"

#include <fmt/format.h>

#include "study/procedures/tow/feasibility.h"

namespace towbench::study::procedures {

StraightTowSettings::StraightTowSettings() noexcept
    : StraightTowSettings({0.05, 0.15, 0.25, 0.35, 0.45, 0.55}) {}  // 8.4.1

StraightTowSettings::StraightTowSettings(std::initializer_list<double> speeds) noexcept {
  for (const double speed : speeds) {
    (void)speeds_m_per_s.push_back(speed);
  }
}

Conversation there_and_back(const Machine& machine, const std::string& name,
                            const StraightTowSettings& settings, double speed_m_per_s) {
  Conversation talk;
  talk.name = name;
  talk.start_m[core::Axis::kY] = settings.start_m;
  talk.start_m[core::Axis::kX] = settings.start_x_m;
  talk.steps = declare_position(talk, machine);
  const double once_s =
      settings.distance_m / speed_m_per_s + settings.acceleration_s + settings.smooth_s + 5.0;
  for (const double way_m : {settings.distance_m, -settings.distance_m}) {
    talk.steps.push_back(
        move(fmt::format("run -trapez y --distance {:.4f}m --speed {:.4f}m/s --acceleration "
                         "{:.3f}s --smooth {:.3f}s --wait 0.5s",
                         way_m, speed_m_per_s, settings.acceleration_s, settings.smooth_s),
             once_s));
  }
  talk.limit_s = 2 * once_s + 5.0;
  return talk;
}

std::string why_not(const Machine& machine, const StraightTowSettings& settings) {
  constexpr double kSteady_s = 0.5;
  if (auto why = no_axis(machine, core::Axis::kY); !why.empty()) {
    return why;
  }
  if (auto why = no_travel(machine, core::Axis::kY, settings.start_m,
                           settings.start_m + settings.distance_m);
      !why.empty()) {
    return why;
  }
  for (const double speed : settings.speeds_m_per_s) {
    if (auto why = too_fast(machine, core::Axis::kY, speed, 0.0); !why.empty()) {
      return why;
    }
    if (auto why = too_short(settings.distance_m, speed, settings.acceleration_s, settings.smooth_s,
                             settings.settle_s + kSteady_s);
        !why.empty()) {
      return why;
    }
  }
  return settings.speeds_m_per_s.empty() ? "no speed is asked for" : "";
}

Tows tow(const Machine& machine, const std::string& name, const StraightTowSettings& settings) {
  Tows tows;
  for (const double speed : settings.speeds_m_per_s) {
    const auto run = fmt::format("{} at {:.3f} m/s", name, speed);
    tows.recordings.push_back(machine.play(there_and_back(machine, run, settings, speed)));
    if (!tows.recordings.back().trouble.empty()) {
      tows.trouble = fmt::format("{}: {}", run, tows.recordings.back().trouble);
      return tows;
    }
  }
  return tows;
}

}  // namespace towbench::study::procedures
