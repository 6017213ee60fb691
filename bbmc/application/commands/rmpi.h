// rmpi: response-based model parameter identification, open loop on one axis (thesis 7.2.1). One
// file a procedure; what they share is here.
#pragma once

#include "bbmc/application/commands/shared_options.h"
#include "bbmc/system/trajectory/duty_program.h"

namespace towbench::bbmc {

inline constexpr OptionSpec kDirectionOption{.name = "--direction",
                                             .short_name = "-d",
                                             .kind = OptionKind::kChoice,
                                             .default_value = 0,
                                             .choices = "+|-",
                                             .meaning = "+ towards max"};
inline constexpr OptionSpec kDutyOption{
    .name = "--duty",
    .short_name = "-a",
    .dimension = Dimension::kDuty,
    .bare_unit = "%",
    .range = core::Range{.min = 0, .max = 100, .min_is_allowed = false},
    .default_value = 10,
    .meaning = "of full drive"};

[[nodiscard]] constexpr OptionSpec time_option(std::string_view name, std::string_view short_name,
                                               std::string_view bare_unit, core::Range range,
                                               double default_value_s,
                                               std::string_view meaning) noexcept {
  return {.name = name,
          .short_name = short_name,
          .dimension = Dimension::kTime,
          .bare_unit = bare_unit,
          .range = range,
          .default_value = default_value_s,
          .meaning = meaning};
}

inline constexpr OptionSpec kRestOption =
    time_option("--rest", "", "s", core::between(0, 60), 1,
                "coasting after it; what then still moves is braked");

[[nodiscard]] inline double signed_by(const Arguments& arguments, std::size_t direction,
                                      double magnitude) noexcept {
  return arguments.choice(direction) == 0 ? magnitude : -magnitude;
}

// Runs the program on one axis, the other without power.
[[nodiscard]] core::ErrorCode drive(CommandContext& context, core::Axis axis,
                                    const DutyProgram& program,
                                    double stop_speed_count_per_s = 0) noexcept;

[[nodiscard]] const CommandSpec& rmpi_pulses_command() noexcept;
[[nodiscard]] const CommandSpec& rmpi_break_away_command() noexcept;
[[nodiscard]] const CommandSpec& rmpi_step_command() noexcept;
[[nodiscard]] const CommandSpec& rmpi_double_step_command() noexcept;
[[nodiscard]] const CommandSpec& rmpi_sine_command() noexcept;
[[nodiscard]] const CommandSpec& rmpi_pid_command() noexcept;

}  // namespace towbench::bbmc
