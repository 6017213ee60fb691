// run -trapez: a trapezoid (4.16)-(4.21) on one axis, the other held; jerk-limited with --smooth.
#include <array>

#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/shared_options.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {
namespace run_trapezoid {

using core::ErrorCode;

enum Option : std::size_t {
  kDof,
  kDistance,
  kSpeed,
  kAcceleration,
  kDeceleration,
  kWait,
  kSmooth,
  kOther,
  kGains,
  kOptionCount = kGains + 5,
};

constexpr std::array<OptionSpec, kOptionCount> kOptions{{
    kDofOrY,
    {.name = "--distance",
     .dimension = Dimension::kLength,
     .bare_unit = "m",
     .range = core::between(-4, 4),
     .default_value = 2,
     .counts_of = CountsOf::kDof,
     .asked_by = AskedBy::kTraject,
     .meaning = "way to go, negative towards min"},
    {.name = "--speed",
     .dimension = Dimension::kSpeed,
     .bare_unit = "m/s",
     .range = core::between(1e-4, 0.70),
     .default_value = 0.1,
     .counts_of = CountsOf::kDof,
     .asked_by = AskedBy::kTraject,
     .meaning = "of the steady part"},
    {.name = "--acceleration",
     .dimension = Dimension::kTime,
     .bare_unit = "s",
     .range = core::between(1e-3, 5),
     .default_value = 0.3,
     .asked_by = AskedBy::kTraject,
     .meaning = "time from rest to speed"},
    {.name = "--deceleration",
     .presence = Presence::kOptional,
     .dimension = Dimension::kTime,
     .bare_unit = "s",
     .range = core::between(1e-3, 5),
     .meaning = "time from speed to rest, if not the same"},
    kWaitOption,
    {.name = "--smooth",
     .dimension = Dimension::kTime,
     .bare_unit = "s",
     .range = core::between(0, 2),
     .default_value = 0,
     .meaning = "S-curve: averaged over this time; one period of the chain leaves it at rest"},
    {.name = "--other",
     .kind = OptionKind::kChoice,
     .default_value = 0,
     .choices = "hold|free",
     .meaning = "what the other axis does"},
    gain_option("--kp", Dimension::kProportionalGain, "proportional gain"),
    gain_option("--ki", Dimension::kIntegralGain, "integral gain"),
    gain_option("--kd", Dimension::kDerivativeGain, "derivative gain"),
    kTrajectFlag,
    kContrlFlag,
}};

core::Result<Trajectory> profile(const CommandContext& context, const Arguments& arguments) {
  const TrapezoidParameters wanted{
      .start_m = position_m(context, arguments.axis(kDof)),
      .distance_m = arguments.number(kDistance),
      .speed_m_per_s = arguments.number(kSpeed),
      .acceleration_time_s = arguments.number(kAcceleration),
      .deceleration_time_s =
          arguments.number(arguments.given(kDeceleration) ? kDeceleration : kAcceleration),
      .wait_s = arguments.number(kWait)};
  if (arguments.number(kSmooth) > 0) {
    return SCurve::make(wanted, arguments.number(kSmooth)).map([](const SCurve& shape) {
      return Trajectory(shape);
    });
  }
  return Trapezoid::make(wanted).map([](const Trapezoid& shape) { return Trajectory(shape); });
}

ErrorCode run_trapezoid(CommandContext& context, const Arguments& arguments) {
  const core::Axis axis = arguments.axis(kDof);
  const core::Axis other = axis == core::Axis::kY ? core::Axis::kX : core::Axis::kY;
  const auto trajectory = profile(context, arguments);
  if (!trajectory) {
    context.why.text("--distance must not be 0");
    return trajectory.error();
  }
  MotionRequest request;
  request.driven[axis] = true;
  request.trajectory[axis] = *trajectory;
  request.driven[other] =
      arguments.choice(kOther) == 0 && context.system.configuration().axes[other].exists;
  request.trajectory[other] = standing(context, other);
  if (const core::Status status = context.system.request_motion(request); !status) {
    return explained(context, status.error());
  }
  announce_motion(context, trajectory->duration_s());
  return apply_gains(context, arguments, kGains, axis);
}

}  // namespace run_trapezoid
}  // namespace

const CommandSpec& run_trapezoid_command() noexcept {
  static constexpr CommandSpec kCommand{.word = "run",
                                        .sub = "-trapez",
                                        .is_default = true,
                                        .options = run_trapezoid::kOptions,
                                        .handler = run_trapezoid::run_trapezoid,
                                        .meaning = "trapezoidal speed profile on one axis"};
  return kCommand;
}

}  // namespace towbench::bbmc
