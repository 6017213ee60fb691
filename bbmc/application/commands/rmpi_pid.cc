// rmpi pid: gains by Ziegler-Nichols, found on the machine itself (thesis 4.2.1, Table 4.1).
#include <array>

#include "bbmc/application/commands/rmpi.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {
namespace rmpi_pid {

using core::ErrorCode;

enum Option : std::size_t { kDof, kAmplitude, kOptionCount };
constexpr std::array<OptionSpec, kOptionCount> kOptions{{
    kDofRequired,
    {.name = "--amplitude",
     .short_name = "-a",
     .dimension = Dimension::kLength,
     .bare_unit = "m",
     .range = core::between(2e-4, 1e-3),
     .default_value = 5e-4,
     .counts_of = CountsOf::kDof,
     .meaning = "of the oscillation at which the gain is critical"},
}};

void report(const SystemManager& system, core::Axis axis, TextWriter& out) {
  const RelayResult& result = system.status().axes[axis].tuning;
  const double metres_per_motor_rad = system.configuration().axes[axis].metres_per_motor_rad();
  const ZieglerNicholsGains gains = ziegler_nichols_pid(result);
  out.text("K_C ");
  write_quantity(out, result.critical_gain_Nm_per_rad, Dimension::kProportionalGain);
  out.text(", T_C ").fixed(1e3 * result.critical_period_s, 2).text("ms at ");
  out.fixed(1e3 * result.amplitude_rad * metres_per_motor_rad, 3).text("mm, relay ");
  out.fixed(1e3 * result.relay_Nm, 2).text("mNm").end_line();
  out.text("Ziegler-Nichols: config gains ").text(core::name_of(axis)).text(" --kp ");
  write_quantity(out, gains.proportional_Nm_per_rad, Dimension::kProportionalGain);
  out.text(" --ki ");
  write_quantity(out, gains.integral_Nm_per_rad_s, Dimension::kIntegralGain);
  out.text(" --kd ");
  write_quantity(out, gains.derivative_Nm_s_per_rad, Dimension::kDerivativeGain);
  out.end_line();
}

ErrorCode run(CommandContext& context, const Arguments& arguments) {
  const core::Axis axis = arguments.axis(kDof);
  const core::Status status =
      context.system.request_tuning({.axis = axis, .amplitude_m = arguments.number(kAmplitude)});
  if (!status) {
    return explained(context, status.error());
  }
  context.out.text("oscillating").end_line();
  context.motion_started = true;
  context.epilogue = report;
  context.epilogue_axis = axis;
  return ErrorCode::kNone;
}

}  // namespace rmpi_pid
}  // namespace

const CommandSpec& rmpi_pid_command() noexcept {
  static constexpr CommandSpec kCommand{.word = "rmpi",
                                        .sub = "pid",
                                        .options = rmpi_pid::kOptions,
                                        .handler = rmpi_pid::run,
                                        .meaning = "finds PID gains by letting the axis oscillate"};
  return kCommand;
}

}  // namespace towbench::bbmc
