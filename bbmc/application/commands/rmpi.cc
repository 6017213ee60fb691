#include "bbmc/application/commands/rmpi.h"

#include <array>

#include "bbmc/application/commands/command_table.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {

core::ErrorCode drive(CommandContext& context, core::Axis axis, const DutyProgram& program,
                      double stop_speed_count_per_s) noexcept {
  OpenLoopRequest request;
  request.driven[axis] = true;
  request.program[axis] = program;
  request.stop_speed_count_per_s = stop_speed_count_per_s;
  if (const core::Status status = context.system.request_open_loop(request); !status) {
    return explained(context, status.error());
  }
  announce_motion(context, program.duration_s());
  return core::ErrorCode::kNone;
}

std::span<const CommandSpec> rmpi_commands() noexcept {
  static const std::array<CommandSpec, 6> kCommands{
      rmpi_pulses_command(),      rmpi_break_away_command(), rmpi_step_command(),
      rmpi_double_step_command(), rmpi_sine_command(),       rmpi_pid_command()};
  return kCommands;
}

}  // namespace towbench::bbmc
