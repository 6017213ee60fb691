// run -sinus: a sinusoid (4.22)-(4.24) on one axis, the other held.
#include <array>

#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/shared_options.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {
namespace run_sinusoid {

using core::ErrorCode;

enum Option : std::size_t {
  kDof,
  kAmplitude,
  kFrequency,
  kPeriod,
  kTurns,
  kEntry,
  kWait,
  kGains,
  kOptionCount = kGains + 5,
};

constexpr std::array<OptionSpec, kOptionCount> kOptions{{
    kDofOrY,
    {.name = "--amplitude",
     .dimension = Dimension::kLength,
     .bare_unit = "m",
     .range = core::between(-1, 1),
     .default_value = 0.1,
     .counts_of = CountsOf::kDof,
     .asked_by = AskedBy::kTraject,
     .meaning = "half the way from end to end, negative towards min"},
    {.name = "--frequency",
     .dimension = Dimension::kFrequency,
     .bare_unit = "Hz",
     .range = core::between(0.01, 5),
     .default_value = 0.25,
     .asked_by = AskedBy::kTraject,
     .meaning = "oscillations a second"},
    {.name = "--period",
     .presence = Presence::kOptional,
     .dimension = Dimension::kTime,
     .bare_unit = "s",
     .range = core::between(0.2, 100),
     .meaning = "time of one oscillation, instead of --frequency"},
    {.name = "--turns",
     .dimension = Dimension::kNone,
     .range = core::between(0.01, 1000),
     .default_value = 2,
     .asked_by = AskedBy::kTraject,
     .meaning = "oscillations, not necessarily whole"},
    {.name = "--entry",
     .dimension = Dimension::kTime,
     .bare_unit = "s",
     .range = core::between(0, 30),
     .default_value = 0,
     .meaning = "time in which the frequency rises, and falls at the end; 0 is the thesis's"},
    kWaitOption,
    gain_option("--kp", Dimension::kProportionalGain, "proportional gain"),
    gain_option("--ki", Dimension::kIntegralGain, "integral gain"),
    gain_option("--kd", Dimension::kDerivativeGain, "derivative gain"),
    kTrajectFlag,
    kContrlFlag,
}};

ErrorCode run_sinusoid(CommandContext& context, const Arguments& arguments) {
  const core::Axis axis = arguments.axis(kDof);
  const core::Axis other = axis == core::Axis::kY ? core::Axis::kX : core::Axis::kY;
  PhaseRampParameters phase{.turns = arguments.number(kTurns),
                            .ramp_s = arguments.number(kEntry),
                            .wait_s = arguments.number(kWait)};
  if (const ErrorCode code =
          chosen_frequency(arguments, kFrequency, kPeriod, phase.frequency_hz, context.why);
      code != ErrorCode::kNone) {
    return code;
  }
  const auto motion = Harmonic::make({.start_m = position_m(context, axis),
                                      .amplitude_m = arguments.number(kAmplitude),
                                      .phase = phase});
  if (!motion) {
    context.why.text("--amplitude must not be 0");
    return motion.error();
  }
  MotionRequest request;
  request.driven[axis] = true;
  request.trajectory[axis] = *motion;
  request.driven[other] = context.system.configuration().axes[other].exists;
  request.trajectory[other] = standing(context, other);
  if (const core::Status status = context.system.request_motion(request); !status) {
    return explained(context, status.error());
  }
  announce_motion(context, motion->duration_s());
  return apply_gains(context, arguments, kGains, axis);
}

}  // namespace run_sinusoid
}  // namespace

const CommandSpec& run_sinusoid_command() noexcept {
  static constexpr CommandSpec kCommand{.word = "run",
                                        .sub = "-sinus",
                                        .options = run_sinusoid::kOptions,
                                        .handler = run_sinusoid::run_sinusoid,
                                        .meaning = "sinusoid on one axis"};
  return kCommand;
}

}  // namespace towbench::bbmc
