// perf: how punctual the control loop is.
#include <array>

#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/shared_options.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

ErrorCode perf_reset(CommandContext& context, const Arguments& /*arguments*/) {
  context.system.perf_log().reset();
  return ErrorCode::kNone;
}

ErrorCode perf_print(CommandContext& context, const Arguments& /*arguments*/) {
  context.report.start(PerfLogReport());
  return ErrorCode::kNone;
}

ErrorCode perf_enable(CommandContext& context, const Arguments& /*arguments*/) {
  context.system.perf_log().enable(true);
  return ErrorCode::kNone;
}

ErrorCode perf_disable(CommandContext& context, const Arguments& /*arguments*/) {
  context.system.perf_log().enable(false);
  return ErrorCode::kNone;
}

}  // namespace

std::span<const CommandSpec> perf_log_commands() noexcept {
  static constexpr std::array<CommandSpec, 4> kCommands{{
      {.word = "perf", .sub = "reset", .handler = perf_reset, .meaning = "empties the perf log"},
      {.word = "perf",
       .sub = "print",
       .handler = perf_print,
       .meaning = "lateness and duration of control ticks"},
      {.word = "perf", .sub = "enable", .handler = perf_enable, .meaning = "measures ticks"},
      {.word = "perf",
       .sub = "disable",
       .handler = perf_disable,
       .meaning = "measures them no more"},
  }};
  return kCommands;
}

}  // namespace towbench::bbmc
