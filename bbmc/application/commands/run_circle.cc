// run -circle: both axes at once, from where the carriage stands. The path is exactly a circle at
// every instant: it is the speed along it that rises and falls (phase_ramp.h), not its shape.
#include <array>

#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/shared_options.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

enum Option : std::size_t {
  kRadius,
  kFrequency,
  kPeriod,
  kTurns,
  kEntry,
  kWait,
  kCentre,
  kDirection,
  kGainsY,
  kGainsX = kGainsY + 3,
  kOptionCount = kGainsX + 5,
};

constexpr std::array<OptionSpec, kOptionCount> kOptions{{
    {.name = "--radius",
     .dimension = Dimension::kLength,
     .bare_unit = "m",
     .range = core::between(1e-3, 0.3),
     .default_value = 0.20,
     .counts_of = CountsOf::kY,
     .asked_by = AskedBy::kTraject,
     .meaning = "of the circle"},
    {.name = "--frequency",
     .dimension = Dimension::kFrequency,
     .bare_unit = "Hz",
     .range = core::between(0.01, 2),
     .default_value = 0.15,
     .asked_by = AskedBy::kTraject,
     .meaning = "turns a second"},
    {.name = "--period",
     .presence = Presence::kOptional,
     .dimension = Dimension::kTime,
     .bare_unit = "s",
     .range = core::between(0.5, 100),
     .meaning = "time of one turn, instead of --frequency"},
    {.name = "--turns",
     .dimension = Dimension::kNone,
     .range = core::between(0.01, 1000),
     .default_value = 2,
     .meaning = "how many, not necessarily whole"},
    {.name = "--entry",
     .dimension = Dimension::kTime,
     .bare_unit = "s",
     .range = core::between(0, 30),
     .default_value = 1,
     .meaning = "time from rest to full speed along the circle, and back; 0 jumps as BBMC 0.5"},
    kWaitOption,
    {.name = "--centre",
     .kind = OptionKind::kChoice,
     .default_value = 0,
     .choices = "+|-",
     .meaning = "side of y on which the centre lies"},
    {.name = "--direction",
     .short_name = "-d",
     .kind = OptionKind::kChoice,
     .default_value = 0,
     .choices = "+|-",
     .meaning = "side of x towards which it starts"},
    gain_option("--kp-y", Dimension::kProportionalGain, "proportional gain of y"),
    gain_option("--ki-y", Dimension::kIntegralGain, "integral gain of y"),
    gain_option("--kd-y", Dimension::kDerivativeGain, "derivative gain of y"),
    gain_option("--kp-x", Dimension::kProportionalGain, "proportional gain of x"),
    gain_option("--ki-x", Dimension::kIntegralGain, "integral gain of x"),
    gain_option("--kd-x", Dimension::kDerivativeGain, "derivative gain of x"),
    kTrajectFlag,
    kContrlFlag,
}};

double signed_radius_m(const Arguments& arguments, Option side) {
  return arguments.choice(side) == 0 ? arguments.number(kRadius) : -arguments.number(kRadius);
}

ErrorCode run_circle(CommandContext& context, const Arguments& arguments) {
  PhaseRampParameters phase{.turns = arguments.number(kTurns),
                            .ramp_s = arguments.number(kEntry),
                            .wait_s = arguments.number(kWait)};
  if (const ErrorCode code =
          chosen_frequency(arguments, kFrequency, kPeriod, phase.frequency_hz, context.why);
      code != ErrorCode::kNone) {
    return code;
  }
  // y = y_0 + r (1 - cos), x = x_0 + r sin: BBMC 0.5's, whose centre lay towards y max.
  const auto y = Harmonic::make({.start_m = position_m(context, core::Axis::kY),
                                 .amplitude_m = signed_radius_m(arguments, kCentre),
                                 .phase = phase});
  const auto x = Harmonic::make({.start_m = position_m(context, core::Axis::kX),
                                 .amplitude_m = signed_radius_m(arguments, kDirection),
                                 .starting_phase_turns = 0.25,
                                 .phase = phase});
  if (!y || !x) {
    return ErrorCode::kRequestBadArgument;
  }
  MotionRequest request;
  request.driven = {{true, true}};
  request.trajectory[core::Axis::kY] = *y;
  request.trajectory[core::Axis::kX] = *x;
  if (const core::Status status = context.system.request_motion(request); !status) {
    return explained(context, status.error());
  }
  announce_motion(context, y->duration_s());
  const ErrorCode code = apply_gains(context, arguments, kGainsY, core::Axis::kY);
  return code != ErrorCode::kNone ? code : apply_gains(context, arguments, kGainsX, core::Axis::kX);
}

}  // namespace

const CommandSpec& run_circle_command() noexcept {
  static constexpr CommandSpec kCommand{.word = "run",
                                        .sub = "-circle",
                                        .options = kOptions,
                                        .handler = run_circle,
                                        .meaning = "circle with both axes"};
  return kCommand;
}

}  // namespace towbench::bbmc
