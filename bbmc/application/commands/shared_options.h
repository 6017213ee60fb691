// Options that several commands have, described once.
#pragma once

#include "bbmc/application/commands/context.h"
#include "bbmc/application/commands/option.h"
#include "bbmc/system/axis_configuration.h"
#include "bbmc/system/trajectory/trajectory.h"

namespace towbench::bbmc {

inline constexpr OptionSpec kDofRequired{
    .name = "DOF", .kind = OptionKind::kAxis, .presence = Presence::kRequired, .meaning = "axis"};
inline constexpr OptionSpec kDofOrY{
    .name = "DOF", .kind = OptionKind::kAxis, .default_value = 0, .meaning = "axis"};

inline constexpr OptionSpec kWaitOption{.name = "--wait",
                                        .dimension = Dimension::kTime,
                                        .bare_unit = "s",
                                        .range = core::between(0, 60),
                                        .default_value = 0.5,
                                        .meaning = "rest before it starts"};

inline constexpr OptionSpec kTrajectFlag{.name = "-traject",
                                         .kind = OptionKind::kFlag,
                                         .presence = Presence::kOptional,
                                         .meaning = "asks for the trajectory's values not given"};
inline constexpr OptionSpec kContrlFlag{.name = "-contrl",
                                        .kind = OptionKind::kFlag,
                                        .presence = Presence::kOptional,
                                        .meaning = "asks for the gains not given"};

// One gain. Bare numbers are BBMC 0.5's; what is not given stays as it is.
[[nodiscard]] constexpr OptionSpec gain_option(std::string_view name, Dimension dimension,
                                               std::string_view meaning) noexcept {
  return {.name = name,
          .presence = Presence::kOptional,
          .dimension = dimension,
          .bare_unit = kBbmcGainUnit,
          .range = core::at_least(0),
          .asked_by = AskedBy::kContrl,
          .meaning = meaning};
}

// The gains of `axis` after the three options from `first` on (K_P, K_I, K_D in that order).
[[nodiscard]] PidGains gains_from(const CommandContext& context, const Arguments& arguments,
                                  std::size_t first, core::Axis axis) noexcept;

// Sets them if one was given; they stay until changed. Never refused for what the parser accepted.
[[nodiscard]] core::ErrorCode apply_gains(CommandContext& context, const Arguments& arguments,
                                          std::size_t first, core::Axis axis) noexcept;

// Frequency from --frequency or --period, of which at most one is given.
[[nodiscard]] core::ErrorCode chosen_frequency(const Arguments& arguments, std::size_t frequency,
                                               std::size_t period, double& frequency_hz,
                                               TextWriter& why) noexcept;

// Where the axis stands, and a reference that stays there.
[[nodiscard]] double position_m(const CommandContext& context, core::Axis axis) noexcept;
[[nodiscard]] Trajectory standing(const CommandContext& context, core::Axis axis) noexcept;

// Adds to a refusal of the system manager what the user has to know to do better.
core::ErrorCode explained(CommandContext& context, core::ErrorCode code) noexcept;

// "moving for 6.8s", and the prompt waits for the end.
void announce_motion(CommandContext& context, double duration_s) noexcept;

}  // namespace towbench::bbmc
