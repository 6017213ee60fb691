// rmpi: response-based model parameter identification, open loop on one axis (thesis 7.2.1).
#include <algorithm>
#include <array>
#include <cmath>

#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/shared_options.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

constexpr OptionSpec kDirectionOption{.name = "--direction",
                                      .short_name = "-d",
                                      .kind = OptionKind::kChoice,
                                      .default_value = 0,
                                      .choices = "+|-",
                                      .meaning = "+ towards max"};
constexpr OptionSpec kDutyOption{
    .name = "--duty",
    .short_name = "-a",
    .dimension = Dimension::kDuty,
    .bare_unit = "%",
    .range = core::Range{.min = 0, .max = 100, .min_is_allowed = false},
    .default_value = 10,
    .meaning = "of full drive"};

constexpr OptionSpec time_option(std::string_view name, std::string_view short_name,
                                 std::string_view bare_unit, core::Range range,
                                 double default_value_s, std::string_view meaning) noexcept {
  return {.name = name,
          .short_name = short_name,
          .dimension = Dimension::kTime,
          .bare_unit = bare_unit,
          .range = range,
          .default_value = default_value_s,
          .meaning = meaning};
}

double signed_by(const Arguments& arguments, std::size_t direction, double magnitude) noexcept {
  return arguments.choice(direction) == 0 ? magnitude : -magnitude;
}

ErrorCode drive(CommandContext& context, core::Axis axis, const DutyProgram& program,
                double stop_speed_count_per_s = 0) {
  OpenLoopRequest request;
  request.driven[axis] = true;
  request.program[axis] = program;
  request.stop_speed_count_per_s = stop_speed_count_per_s;
  if (const core::Status status = context.system.request_open_loop(request); !status) {
    return explained(context, status.error());
  }
  announce_motion(context, program.duration_s());
  return ErrorCode::kNone;
}

namespace pulses {

enum Option : std::size_t {
  kDof,
  kDuty,
  kDirection,
  kOn,
  kOff,
  kPulses,
  kDuration,
  kWait,
  kAlternate,
  kOptionCount,
};

constexpr core::Range kEdgeRange = core::between(0.005, 1);

constexpr OptionSpec with_second_value(OptionSpec option) noexcept {
  option.short_name_takes_two = true;
  return option;
}

constexpr std::array<OptionSpec, kOptionCount> kOptions{{
    kDofRequired,
    kDutyOption,
    kDirectionOption,
    with_second_value(time_option("--on", "-p", "ms", kEdgeRange, 0.2,
                                  "length of a pulse (-p takes this and the next)")),
    time_option("--off", "", "ms", kEdgeRange, 0.3, "pause after it"),
    {.name = "--pulses",
     .kind = OptionKind::kWhole,
     .presence = Presence::kOptional,
     .range = core::between(1, 1000),
     .meaning = "how many, instead of --duration"},
    time_option("--duration", "-t", "s", core::between(0.01, 131), 5,
                "of all pulses; a started one is finished"),
    kWaitOption,
    {.name = "--alternate",
     .kind = OptionKind::kFlag,
     .presence = Presence::kOptional,
     .meaning = "every second pulse the other way"},
}};

ErrorCode run(CommandContext& context, const Arguments& arguments) {
  if (arguments.given(kPulses) && arguments.given(kDuration)) {
    context.why.text("--pulses and --duration say the same; give one");
    return ErrorCode::kRequestBadArgument;
  }
  const double period_s = arguments.number(kOn) + arguments.number(kOff);
  // A millionth of a pulse of grace: 5 s of 0.2 s + 0.3 s are ten.
  const double fitting = std::ceil(arguments.number(kDuration) / period_s - 1e-6);
  const double count = arguments.given(kPulses) ? arguments.number(kPulses) : fitting;
  const auto program =
      PulseProgram::make({.duty_pct = signed_by(arguments, kDirection, arguments.number(kDuty)),
                          .on_s = arguments.number(kOn),
                          .off_s = arguments.number(kOff),
                          .wait_s = arguments.number(kWait),
                          .pulses = static_cast<std::int32_t>(std::max(count, 1.0)),
                          .alternate = arguments.given(kAlternate)});
  return program ? drive(context, arguments.axis(kDof), *program) : program.error();
}

}  // namespace pulses

namespace break_away {

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

}  // namespace break_away

namespace step {

enum Option : std::size_t { kDof, kDuty, kDirection, kTime, kWait, kOptionCount };

constexpr std::array<OptionSpec, kOptionCount> kOptions{{
    kDofRequired,
    kDutyOption,
    kDirectionOption,
    time_option("--time", "-t", "s", core::between(0.001, 60), 0.5, "length of the step"),
    kWaitOption,
}};

ErrorCode run(CommandContext& context, const Arguments& arguments) {
  const auto program =
      PulseProgram::make({.duty_pct = signed_by(arguments, kDirection, arguments.number(kDuty)),
                          .on_s = arguments.number(kTime),
                          .off_s = 0,
                          .wait_s = arguments.number(kWait),
                          .pulses = 1});
  return program ? drive(context, arguments.axis(kDof), *program) : program.error();
}

}  // namespace step
}  // namespace

const CommandSpec& rmpi_pulses_command() noexcept {
  static constexpr CommandSpec kCommand{.word = "rmpi",
                                        .sub = "si",
                                        .options = pulses::kOptions,
                                        .handler = pulses::run,
                                        .meaning = "square-wave pulses in open loop"};
  return kCommand;
}

const CommandSpec& rmpi_break_away_command() noexcept {
  static constexpr CommandSpec kCommand{.word = "rmpi",
                                        .sub = "break",
                                        .options = break_away::kOptions,
                                        .handler = break_away::run,
                                        .meaning = "raises the duty until the axis moves"};
  return kCommand;
}

const CommandSpec& rmpi_step_command() noexcept {
  static constexpr CommandSpec kCommand{.word = "rmpi",
                                        .sub = "step",
                                        .options = step::kOptions,
                                        .handler = step::run,
                                        .meaning = "one step of duty in open loop"};
  return kCommand;
}

}  // namespace towbench::bbmc
