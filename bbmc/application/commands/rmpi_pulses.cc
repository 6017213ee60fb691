// rmpi si: square-wave pulses (thesis 7.2.1) or a pseudo-random binary sequence.
#include <algorithm>
#include <array>
#include <cmath>

#include "bbmc/application/commands/rmpi.h"

namespace towbench::bbmc {
namespace {
namespace rmpi_pulses {

using core::ErrorCode;

enum Option : std::size_t {
  kDof,
  kDuty,
  kDirection,
  kOn,
  kOff,
  kPulses,
  kDuration,
  kWait,
  kRest,
  kAlternate,
  kSignal,
  kBit,
  kOrder,
  kPeriods,
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
    kRestOption,
    {.name = "--alternate",
     .kind = OptionKind::kFlag,
     .presence = Presence::kOptional,
     .meaning = "every second pulse the other way"},
    {.name = "--signal",
     .kind = OptionKind::kChoice,
     .default_value = 0,
     .choices = "pulses|prbs",
     .meaning = "pulses, or a pseudo-random binary sequence of the options below"},
    time_option("--bit", "", "ms", core::between(0.001, 1), 0.05, "time of one bit"),
    {.name = "--order",
     .kind = OptionKind::kWhole,
     .range = core::between(4, 11),
     .default_value = 6,
     .meaning = "N: the sequence has 2^N - 1 bits"},
    {.name = "--periods",
     .kind = OptionKind::kWhole,
     .range = core::between(1, 100),
     .default_value = 1,
     .meaning = "of the sequence"},
}};

ErrorCode run_prbs(CommandContext& context, const Arguments& arguments) {
  const auto program =
      PrbsProgram::make({.duty_pct = signed_by(arguments, kDirection, arguments.number(kDuty)),
                         .bit_s = arguments.number(kBit),
                         .order = static_cast<std::int32_t>(arguments.number(kOrder)),
                         .periods = static_cast<std::int32_t>(arguments.number(kPeriods)),
                         .wait_s = arguments.number(kWait)});
  if (!program) {
    context.why.text("that would take more than a day");
    return program.error();
  }
  return drive(context, arguments.axis(kDof), DutyProgram(*program, arguments.number(kRest)));
}

ErrorCode run(CommandContext& context, const Arguments& arguments) {
  if (arguments.choice(kSignal) == 1) {
    return run_prbs(context, arguments);
  }
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
  if (!program) {
    return program.error();
  }
  return drive(context, arguments.axis(kDof), DutyProgram(*program, arguments.number(kRest)));
}

}  // namespace rmpi_pulses
}  // namespace

const CommandSpec& rmpi_pulses_command() noexcept {
  static constexpr CommandSpec kCommand{.word = "rmpi",
                                        .sub = "si",
                                        .options = rmpi_pulses::kOptions,
                                        .handler = rmpi_pulses::run,
                                        .meaning = "square-wave pulses in open loop"};
  return kCommand;
}

}  // namespace towbench::bbmc
