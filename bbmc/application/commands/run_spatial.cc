// run -spatial: a trapezoid on Y while X swings, so that the end-effector draws a sinusoid along
// the tank (thesis 4.3). X swings a whole number of times and comes to rest together with Y.
#include <array>

#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/machine_axes.h"
#include "bbmc/application/commands/shared_options.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {
namespace run_spatial {

using core::ErrorCode;

enum Option : std::size_t { kDistance, kSpeed, kAcceleration, kAmplitude, kWaves, kWait, kCount };

constexpr std::array<OptionSpec, kCount> kOptions{{
    {.name = "--distance",
     .dimension = Dimension::kLength,
     .bare_unit = "m",
     .range = core::between(-4, 4),
     .default_value = 1,
     .counts_of = CountsOf::kY,
     .meaning = "way of y, negative towards min"},
    {.name = "--speed",
     .dimension = Dimension::kSpeed,
     .bare_unit = "m/s",
     .range = core::between(1e-4, 0.70),
     .default_value = 0.1,
     .counts_of = CountsOf::kY,
     .meaning = "of y"},
    {.name = "--acceleration",
     .dimension = Dimension::kTime,
     .bare_unit = "s",
     .range = core::between(1e-3, 5),
     .default_value = 0.5,
     .meaning = "time from rest to speed and back, on both axes"},
    {.name = "--amplitude",
     .dimension = Dimension::kLength,
     .bare_unit = "m",
     .range = core::between(-0.3, 0.3),
     .default_value = 0.05,
     .counts_of = CountsOf::kX,
     .meaning = "of x, to each side; negative starts towards min"},
    {.name = "--waves",
     .kind = OptionKind::kWhole,
     .range = core::between(1, 100),
     .default_value = 4,
     .meaning = "swings of x on the way"},
    kWaitOption,
}};

ErrorCode run_spatial(CommandContext& context, const Arguments& arguments) {
  if (const ErrorCode code = must_have_both(context.system.configuration(), context.why);
      code != ErrorCode::kNone) {
    return code;
  }
  const auto y = Trapezoid::make({.start_m = position_m(context, core::Axis::kY),
                                  .distance_m = arguments.number(kDistance),
                                  .speed_m_per_s = arguments.number(kSpeed),
                                  .acceleration_time_s = arguments.number(kAcceleration),
                                  .deceleration_time_s = arguments.number(kAcceleration),
                                  .wait_s = arguments.number(kWait)});
  if (!y || arguments.number(kAmplitude) == 0) {
    context.why.text("--distance and --amplitude must not be 0");
    return ErrorCode::kRequestBadArgument;
  }
  // N turns with ramps of t_a take N / f + t_a: as long as Y takes.
  const double turns = arguments.number(kWaves);
  const double ramp_s = y->acceleration_time_s();
  const double moving_s = y->duration_s() - arguments.number(kWait);
  const auto x = Harmonic::make({.start_m = position_m(context, core::Axis::kX),
                                 .amplitude_m = arguments.number(kAmplitude),
                                 .starting_phase_turns = 0.25,
                                 .phase = {.frequency_hz = turns / (moving_s - ramp_s),
                                           .turns = turns,
                                           .ramp_s = ramp_s,
                                           .wait_s = arguments.number(kWait)}});
  if (!x) {
    return x.error();
  }
  MotionRequest request;
  request.driven = {{true, true}};
  request.trajectory[core::Axis::kY] = *y;
  request.trajectory[core::Axis::kX] = *x;
  if (const core::Status status = context.system.request_motion(request); !status) {
    return explained(context, status.error());
  }
  announce_motion(context, y->duration_s());
  return ErrorCode::kNone;
}

}  // namespace run_spatial
}  // namespace

const CommandSpec& run_spatial_command() noexcept {
  static constexpr CommandSpec kCommand{.word = "run",
                                        .sub = "-spatial",
                                        .options = run_spatial::kOptions,
                                        .handler = run_spatial::run_spatial,
                                        .meaning = "sinusoid in space: y goes, x swings"};
  return kCommand;
}

}  // namespace towbench::bbmc
