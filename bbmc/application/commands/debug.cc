// debug: what the law did, after each motion.
#include <array>

#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/context.h"

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

ErrorCode enable(CommandContext& context, const Arguments& /*arguments*/) {
  context.settings.debug = true;
  return ErrorCode::kNone;
}

ErrorCode disable(CommandContext& context, const Arguments& /*arguments*/) {
  context.settings.debug = false;
  return ErrorCode::kNone;
}

}  // namespace

std::span<const CommandSpec> debug_commands() noexcept {
  static constexpr std::array<CommandSpec, 2> kCommands{{
      {.word = "debug",
       .sub = "enable",
       .handler = enable,
       .meaning = "after each motion, what the law did"},
      {.word = "debug", .sub = "disable", .handler = disable, .meaning = "no longer"},
  }};
  return kCommands;
}

}  // namespace towbench::bbmc
