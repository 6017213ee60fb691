// datalog: BBMC's own record of the control loop.
#include <array>

#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/shared_options.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

enum LogOption : std::size_t { kLogDof };
constexpr std::array<OptionSpec, 1> kLogOptions{{{.name = "DOF",
                                                  .kind = OptionKind::kAxis,
                                                  .presence = Presence::kOptional,
                                                  .meaning = "axis; both if not given"}}};

PerAxis<bool> wanted_axes(const CommandContext& context, const Arguments& arguments) {
  const AxesConfiguration& axes = context.system.configuration().axes;
  PerAxis<bool> wanted{{axes[core::Axis::kY].exists, axes[core::Axis::kX].exists}};
  if (arguments.given(kLogDof)) {
    wanted = {};
    wanted[arguments.axis(kLogDof)] = true;
  }
  return wanted;
}

ErrorCode log_reset(CommandContext& context, const Arguments& /*arguments*/) {
  context.system.data_log().reset();
  return ErrorCode::kNone;
}

ErrorCode log_print(CommandContext& context, const Arguments& arguments) {
  const DataLog& log = context.system.data_log();
  if (log.rows().empty()) {
    context.why.text("the data log is empty");
    return ErrorCode::kRequestWrongState;
  }
  context.out.integer(static_cast<std::int64_t>(log.rows().size())).text(" rows").end_line();
  if (log.refused() > 0) {
    context.out.text("log full: ").integer(static_cast<std::int64_t>(log.refused()));
    context.out.text(" rows more were not recorded").end_line();
  }
  context.report.start(DataLogReport(wanted_axes(context, arguments)));
  return ErrorCode::kNone;
}

ErrorCode log_switch(CommandContext& context, const Arguments& arguments, bool on) {
  const PerAxis<bool> wanted = wanted_axes(context, arguments);
  for (const core::Axis axis : kAxes) {
    if (wanted[axis]) {
      context.system.data_log().enable(axis, on);
    }
  }
  return ErrorCode::kNone;
}

ErrorCode log_enable(CommandContext& context, const Arguments& arguments) {
  return log_switch(context, arguments, true);
}

ErrorCode log_disable(CommandContext& context, const Arguments& arguments) {
  return log_switch(context, arguments, false);
}

}  // namespace

std::span<const CommandSpec> data_log_commands() noexcept {
  static constexpr std::array<CommandSpec, 4> kCommands{{
      {.word = "datalog", .sub = "reset", .handler = log_reset, .meaning = "empties the data log"},
      {.word = "datalog",
       .sub = "print",
       .options = kLogOptions,
       .handler = log_print,
       .meaning = "prints it as comma separated values"},
      {.word = "datalog",
       .sub = "enable",
       .options = kLogOptions,
       .handler = log_enable,
       .meaning = "records an axis from the next motion on"},
      {.word = "datalog",
       .sub = "disable",
       .options = kLogOptions,
       .handler = log_disable,
       .meaning = "records it no more"},
  }};
  return kCommands;
}

}  // namespace towbench::bbmc
