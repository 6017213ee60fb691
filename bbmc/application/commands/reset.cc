// reset: a latched fault (systate), or where an axis stands (poscalib).
#include <array>
#include <cmath>

#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/shared_options.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

enum CalibrationOption : std::size_t { kCalibrationDof, kPosition, kForget };
constexpr std::array<OptionSpec, 3> kCalibrationOptions{{
    kDofRequired,
    {.name = "POSITION",
     .presence = Presence::kOptional,
     .dimension = Dimension::kPosition,
     .bare_unit = "counts",
     .counts_of = CountsOf::kDof,
     .meaning = "where the axis stands now"},
    {.name = "--forget",
     .kind = OptionKind::kFlag,
     .presence = Presence::kOptional,
     .meaning = "instead: the position is not known"},
}};

ErrorCode calibrate(CommandContext& context, const Arguments& arguments) {
  const core::Axis axis = arguments.axis(kCalibrationDof);
  if (arguments.given(kPosition) == arguments.given(kForget)) {
    context.why.text("POSITION or --forget");
    return ErrorCode::kRequestMissingArgument;
  }
  const AxisConfiguration& configuration = context.system.configuration().axes[axis];
  core::Status done;
  if (arguments.given(kForget)) {
    done = context.system.forget_calibration(axis);
  } else {
    const double count = std::floor(arguments.number(kPosition) * configuration.counts_per_m());
    if (!(std::fabs(count) < 1e12)) {
      context.why.text("POSITION is beyond every tank");
      return ErrorCode::kRequestOutOfRange;
    }
    done = context.system.calibrate_position(axis, static_cast<std::int64_t>(count));
  }
  return done ? ErrorCode::kNone : explained(context, done.error());
}

ErrorCode reset_state(CommandContext& context, const Arguments& /*arguments*/) {
  const core::Status done = context.system.reset();
  if (!done && done.error() == ErrorCode::kRequestWrongState && context.system.at_rest()) {
    context.why.text("no fault is latched");
    return done.error();
  }
  return done ? ErrorCode::kNone : explained(context, done.error());
}

}  // namespace

std::span<const CommandSpec> reset_commands() noexcept {
  static constexpr std::array<CommandSpec, 2> kCommands{{
      {.word = "reset",
       .sub = "systate",
       .is_default = true,
       .handler = reset_state,
       .meaning = "clears a latched fault, switch released"},
      {.word = "reset",
       .sub = "poscalib",
       .options = kCalibrationOptions,
       .handler = calibrate,
       .meaning = "declares where an axis stands"},
  }};
  return kCommands;
}

}  // namespace towbench::bbmc
