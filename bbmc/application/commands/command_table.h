// Every command there is, in the order in which help lists them.
#pragma once

#include <span>

#include "bbmc/application/commands/option.h"

namespace towbench::bbmc {

[[nodiscard]] std::span<const CommandSpec> command_table() noexcept;

// One group a file: run.cc, goto.cc, ...
[[nodiscard]] const CommandSpec& run_trapezoid_command() noexcept;
[[nodiscard]] const CommandSpec& run_circle_command() noexcept;
[[nodiscard]] const CommandSpec& run_ellipse_command() noexcept;
[[nodiscard]] const CommandSpec& run_sinusoid_command() noexcept;
[[nodiscard]] const CommandSpec& run_spatial_command() noexcept;
[[nodiscard]] std::span<const CommandSpec> path_commands() noexcept;  // run -path as well
[[nodiscard]] const CommandSpec& goto_command() noexcept;
[[nodiscard]] const CommandSpec& goto_home_command() noexcept;
[[nodiscard]] const CommandSpec& poscalib_command() noexcept;
[[nodiscard]] std::span<const CommandSpec> rmpi_commands() noexcept;
[[nodiscard]] const CommandSpec& status_command() noexcept;
[[nodiscard]] std::span<const CommandSpec> data_log_commands() noexcept;
[[nodiscard]] std::span<const CommandSpec> perf_log_commands() noexcept;
[[nodiscard]] std::span<const CommandSpec> reset_commands() noexcept;
[[nodiscard]] std::span<const CommandSpec> config_commands() noexcept;
[[nodiscard]] std::span<const CommandSpec> test_commands() noexcept;
[[nodiscard]] std::span<const CommandSpec> debug_commands() noexcept;
[[nodiscard]] const CommandSpec& help_command() noexcept;
[[nodiscard]] const CommandSpec& quit_command() noexcept;

}  // namespace towbench::bbmc
