// status: where everything stands.
#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/shared_options.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

ErrorCode status(CommandContext& context, const Arguments& /*arguments*/) {
  context.report.start(StatusReport());
  return ErrorCode::kNone;
}

}  // namespace

const CommandSpec& status_command() noexcept {
  static constexpr CommandSpec kCommand{
      .word = "status", .handler = status, .meaning = "where everything stands"};
  return kCommand;
}

}  // namespace towbench::bbmc
