// rmpi step, rmpi dstep: one step of duty, or two of which the second follows on the first.
#include <array>

#include "bbmc/application/commands/rmpi.h"

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

// A program cannot begin with nothing to wait for: a step of no length is left out.
ErrorCode run_steps(CommandContext& context, core::Axis axis, std::span<const DutyStep> steps,
                    double rest_s) {
  const auto program =
      StepsProgram::make(steps.front().time_s > 0 ? steps : steps.last(steps.size() - 1));
  return program ? drive(context, axis, DutyProgram(*program, rest_s)) : program.error();
}

namespace single {

enum Option : std::size_t { kDof, kDuty, kDirection, kTime, kWait, kRest, kOptionCount };
constexpr std::array<OptionSpec, kOptionCount> kOptions{{
    kDofRequired,
    kDutyOption,
    kDirectionOption,
    time_option("--time", "-t", "s", core::between(0.001, 60), 0.5, "length of the step"),
    kWaitOption,
    kRestOption,
}};

ErrorCode run(CommandContext& context, const Arguments& arguments) {
  const std::array<DutyStep, 2> steps{{
      {.duty_pct = 0, .time_s = arguments.number(kWait)},
      {.duty_pct = signed_by(arguments, kDirection, arguments.number(kDuty)),
       .time_s = arguments.number(kTime)},
  }};
  return run_steps(context, arguments.axis(kDof), steps, arguments.number(kRest));
}

}  // namespace single

namespace twofold {

enum Option : std::size_t {
  kDof,
  kDuty,
  kDirection,
  kTime,
  kSecondDuty,
  kSecondTime,
  kWait,
  kRest,
  kOptionCount,
};
constexpr std::array<OptionSpec, kOptionCount> kOptions{{
    kDofRequired,
    kDutyOption,
    kDirectionOption,
    time_option("--time", "-t", "s", core::between(0.001, 60), 0.3, "length of the first step"),
    {.name = "--second-duty",
     .dimension = Dimension::kDuty,
     .bare_unit = "%",
     .range = core::between(-100, 100),
     .default_value = 5,
     .meaning = "of the second step, negative against the direction"},
    time_option("--second-time", "", "s", core::between(0.001, 60), 0.3,
                "length of the second step"),
    kWaitOption,
    kRestOption,
}};

ErrorCode run(CommandContext& context, const Arguments& arguments) {
  const std::array<DutyStep, 3> steps{{
      {.duty_pct = 0, .time_s = arguments.number(kWait)},
      {.duty_pct = signed_by(arguments, kDirection, arguments.number(kDuty)),
       .time_s = arguments.number(kTime)},
      {.duty_pct = signed_by(arguments, kDirection, arguments.number(kSecondDuty)),
       .time_s = arguments.number(kSecondTime)},
  }};
  return run_steps(context, arguments.axis(kDof), steps, arguments.number(kRest));
}

}  // namespace twofold
}  // namespace

const CommandSpec& rmpi_step_command() noexcept {
  static constexpr CommandSpec kCommand{.word = "rmpi",
                                        .sub = "step",
                                        .options = single::kOptions,
                                        .handler = single::run,
                                        .meaning = "one step of duty in open loop"};
  return kCommand;
}

const CommandSpec& rmpi_double_step_command() noexcept {
  static constexpr CommandSpec kCommand{.word = "rmpi",
                                        .sub = "dstep",
                                        .options = twofold::kOptions,
                                        .handler = twofold::run,
                                        .meaning = "two steps of duty in open loop"};
  return kCommand;
}

}  // namespace towbench::bbmc
