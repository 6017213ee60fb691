// quit: ends the controller, not in the middle of a motion.
#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/shared_options.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

ErrorCode quit(CommandContext& context, const Arguments& /*arguments*/) {
  if (!context.system.at_rest()) {
    context.why.text("a motion runs");
    return ErrorCode::kRequestWrongState;
  }
  context.settings.quit = true;
  return ErrorCode::kNone;
}

}  // namespace

const CommandSpec& quit_command() noexcept {
  static constexpr CommandSpec kCommand{
      .word = "quit", .handler = quit, .meaning = "ends the controller"};
  return kCommand;
}

}  // namespace towbench::bbmc
