// rmpi sine: a sine of duty, for frequency responses.
#include <array>

#include "bbmc/application/commands/rmpi.h"

namespace towbench::bbmc {
namespace {
namespace rmpi_sine {

using core::ErrorCode;

enum Option : std::size_t { kDof, kDuty, kOffset, kFrequency, kCycles, kWait, kRest, kOptionCount };
constexpr std::array<OptionSpec, kOptionCount> kOptions{{
    kDofRequired,
    kDutyOption,
    {.name = "--offset",
     .dimension = Dimension::kDuty,
     .bare_unit = "%",
     .range = core::between(-100, 100),
     .default_value = 0,
     .meaning = "duty around which it swings"},
    {.name = "--frequency",
     .dimension = Dimension::kFrequency,
     .bare_unit = "Hz",
     .range = core::between(0.01, 100),
     .default_value = 1,
     .meaning = "of the sine"},
    {.name = "--cycles",
     .dimension = Dimension::kNone,
     .range = core::between(0.1, 10'000),
     .default_value = 5,
     .meaning = "how many"},
    kWaitOption,
    kRestOption,
}};

ErrorCode run(CommandContext& context, const Arguments& arguments) {
  const auto program = SineProgram::make({.amplitude_pct = arguments.number(kDuty),
                                          .offset_pct = arguments.number(kOffset),
                                          .frequency_hz = arguments.number(kFrequency),
                                          .cycles = arguments.number(kCycles),
                                          .wait_s = arguments.number(kWait)});
  if (!program) {
    context.why.text("--duty and --offset together must not pass 100%, nor the time a day");
    return program.error();
  }
  return drive(context, arguments.axis(kDof), DutyProgram(*program, arguments.number(kRest)));
}

}  // namespace rmpi_sine
}  // namespace

const CommandSpec& rmpi_sine_command() noexcept {
  static constexpr CommandSpec kCommand{.word = "rmpi",
                                        .sub = "sine",
                                        .options = rmpi_sine::kOptions,
                                        .handler = rmpi_sine::run,
                                        .meaning = "sine of duty in open loop"};
  return kCommand;
}

}  // namespace towbench::bbmc
