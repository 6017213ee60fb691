#include "bbmc/application/commands/shared_options.h"

#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {

using core::ErrorCode;

PidGains gains_from(const CommandContext& context, const Arguments& arguments, std::size_t first,
                    core::Axis axis) noexcept {
  const Configuration& configuration = context.system.configuration();
  const AxisConfiguration& axis_configuration = configuration.axes[axis];
  const PidGains converted = gains_from_bbmc_units(
      axis_configuration, configuration.control_rate_Hz, arguments.number(first),
      arguments.number(first + 1), arguments.number(first + 2));
  PidGains gains = axis_configuration.gains;
  const auto choose = [&](std::size_t offset, double from_bbmc, double& gain) {
    const std::size_t option = first + offset;
    if (arguments.given(option)) {
      gain = arguments.in_bbmc_units(option) ? from_bbmc : arguments.number(option);
    }
  };
  choose(0, converted.proportional_Nm_per_rad, gains.proportional_Nm_per_rad);
  choose(1, converted.integral_Nm_per_rad_s, gains.integral_Nm_per_rad_s);
  choose(2, converted.derivative_Nm_s_per_rad, gains.derivative_Nm_s_per_rad);
  return gains;
}

ErrorCode apply_gains(CommandContext& context, const Arguments& arguments, std::size_t first,
                      core::Axis axis) noexcept {
  if (!arguments.given(first) && !arguments.given(first + 1) && !arguments.given(first + 2)) {
    return ErrorCode::kNone;
  }
  const core::Status status =
      context.system.set_gains(axis, gains_from(context, arguments, first, axis));
  return status ? ErrorCode::kNone : explained(context, status.error());
}

ErrorCode chosen_frequency(const Arguments& arguments, std::size_t frequency, std::size_t period,
                           double& frequency_hz, TextWriter& why) noexcept {
  if (arguments.given(frequency) && arguments.given(period)) {
    why.text("--frequency and --period say the same; give one");
    return ErrorCode::kRequestBadArgument;
  }
  frequency_hz =
      arguments.given(period) ? 1.0 / arguments.number(period) : arguments.number(frequency);
  return ErrorCode::kNone;
}

double position_m(const CommandContext& context, core::Axis axis) noexcept {
  return context.system.status().axes[axis].position_m;
}

Trajectory standing(const CommandContext& context, core::Axis axis) noexcept {
  return Hold(position_m(context, axis));
}

ErrorCode explained(CommandContext& context, ErrorCode code) noexcept {
  const SystemStatus& status = context.system.status();
  const Configuration& configuration = context.system.configuration();
  TextWriter& why = context.why;
  std::string_view separator;
  switch (code) {
    case ErrorCode::kRequestFaultLatched:
      why.text("fault ").integer(core::number_of(status.fault)).text(" ");
      why.text(core::describe(status.fault)).text("; `reset` clears it");
      break;
    case ErrorCode::kRequestNotCalibrated:
      why.text(
          "`poscalib` finds out where the axes stand, `reset poscalib DOF POSITION` declares it");
      break;
    case ErrorCode::kRequestSwitchPressed:
      why.text("the kill switch is pressed");
      break;
    case ErrorCode::kRequestWrongState:
      why.text(context.system.at_rest() ? "" : "a motion runs");
      break;
    case ErrorCode::kRequestBeyondSoftLimit:
      for (const core::Axis axis : kAxes) {
        if (!configuration.axes[axis].exists) {
          continue;
        }
        const EndsConfiguration& ends = configuration.axes[axis].ends;
        why.text(separator)
            .text(core::name_of(axis))
            .text(" goes from ")
            .integer(ends.soft_min_count);
        why.text(" to ").integer(ends.soft_max_count).text(" counts and stands at ");
        why.integer(status.axes[axis].count);
        separator = ", ";
      }
      break;
    case ErrorCode::kRequestTooFast:
      for (const core::Axis axis : kAxes) {
        if (!configuration.axes[axis].exists) {
          continue;
        }
        why.text(separator).text(core::name_of(axis)).text(" here at most ");
        why.fixed(context.system.speed_allowed_m_per_s(axis, position_m(context, axis), -1), 4);
        why.text("m/s towards min, ");
        why.fixed(context.system.speed_allowed_m_per_s(axis, position_m(context, axis), 1), 4);
        why.text("m/s towards max");
        separator = "; ";
      }
      break;
    default:
      break;
  }
  return code;
}

void announce_motion(CommandContext& context, double duration_s) noexcept {
  context.motion_started = true;
  context.out.text("moving for ").fixed(duration_s, 2).text("s").end_line();
}

}  // namespace towbench::bbmc
