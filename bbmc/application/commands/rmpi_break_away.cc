// rmpi break: how much duty it takes until the axis moves (EXP-OL-1).
#include <array>

#include "bbmc/application/commands/rmpi.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {
namespace rmpi_break_away {

using core::ErrorCode;

enum Option : std::size_t {
  kDof,
  kIncrement,
  kStep,
  kStopSpeed,
  kLimit,
  kDirection,
  kOptionCount,
};

constexpr std::array<OptionSpec, kOptionCount> kOptions{{
    kDofRequired,
    {.name = "--increment",
     .dimension = Dimension::kDuty,
     .bare_unit = "%",
     .range = core::between(0.001, 5),
     .default_value = 0.05,
     .meaning = "duty added at each step"},
    time_option("--step", "", "ms", core::between(1e-3, 10), 0.02, "time of one step"),
    {.name = "--stop-speed",
     .short_name = "-st",
     .dimension = Dimension::kSpeed,
     .bare_unit = "counts/s",
     .range = core::between(1e-5, 0.1),
     .default_text = "1000counts/s",
     .counts_of = CountsOf::kDof,
     .meaning = "faster than this is motion"},
    {.name = "--limit",
     .dimension = Dimension::kDuty,
     .bare_unit = "%",
     .range = core::between(1, 50),
     .default_value = 20,
     .meaning = "duty at which it gives up"},
    kDirectionOption,
}};

void report(const SystemManager& system, core::Axis axis, TextWriter& out) {
  const AxisStatus& state = system.status().axes[axis];
  if (state.break_away_duty_pct == 0) {
    out.text("did not break away");
  } else {
    out.text("broke away at ").integer(state.break_away_count).text(" counts with ");
    out.fixed(state.break_away_duty_pct, 2).text("%");
  }
  out.end_line();
}

ErrorCode run(CommandContext& context, const Arguments& arguments) {
  const core::Axis axis = arguments.axis(kDof);
  const auto program = BreakAwayProgram::make(
      {.increment_pct = signed_by(arguments, kDirection, arguments.number(kIncrement)),
       .step_s = arguments.number(kStep),
       .limit_pct = arguments.number(kLimit)});
  if (!program) {
    context.why.text("--increment must fit into --limit");
    return program.error();
  }
  const double stop_speed_count_per_s =
      arguments.number(kStopSpeed) * context.system.configuration().axes[axis].counts_per_m();
  context.epilogue = report;
  context.epilogue_axis = axis;
  return drive(context, axis, *program, stop_speed_count_per_s);
}

}  // namespace rmpi_break_away
}  // namespace

const CommandSpec& rmpi_break_away_command() noexcept {
  static constexpr CommandSpec kCommand{.word = "rmpi",
                                        .sub = "break",
                                        .options = rmpi_break_away::kOptions,
                                        .handler = rmpi_break_away::run,
                                        .meaning = "raises the duty until the axis moves"};
  return kCommand;
}

}  // namespace towbench::bbmc
