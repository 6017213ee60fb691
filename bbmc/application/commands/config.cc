// config: what can be set while the controller runs (OR-BBMC-2d).
#include <array>

#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/shared_options.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

constexpr std::string_view kOnOff = "on|off";

namespace gains {

enum Option : std::size_t { kDof, kGains, kOptionCount = kGains + 3 };
constexpr std::array<OptionSpec, kOptionCount> kOptions{{
    kDofRequired,
    gain_option("--kp", Dimension::kProportionalGain, "proportional gain"),
    gain_option("--ki", Dimension::kIntegralGain, "integral gain"),
    gain_option("--kd", Dimension::kDerivativeGain, "derivative gain"),
}};

ErrorCode set(CommandContext& context, const Arguments& arguments) {
  const core::Axis axis = arguments.axis(kDof);
  if (const ErrorCode code = apply_gains(context, arguments, kGains, axis);
      code != ErrorCode::kNone) {
    return code;
  }
  const PidGains& now = context.system.configuration().axes[axis].gains;
  TextWriter& out = context.out;
  out.text(core::name_of(axis)).text(": kp ");
  write_quantity(out, now.proportional_Nm_per_rad, Dimension::kProportionalGain);
  out.text(", ki ");
  write_quantity(out, now.integral_Nm_per_rad_s, Dimension::kIntegralGain);
  out.text(", kd ");
  write_quantity(out, now.derivative_Nm_s_per_rad, Dimension::kDerivativeGain);
  out.end_line();
  return ErrorCode::kNone;
}

}  // namespace gains

namespace law {

enum Option : std::size_t { kDof, kFeedForward, kOptionCount };
constexpr std::array<OptionSpec, kOptionCount> kOptions{{
    kDofRequired,
    {.name = "--feed-forward",
     .kind = OptionKind::kChoice,
     .presence = Presence::kOptional,
     .choices = kOnOff,
     .meaning = "torque of the identified model added to the PID law"},
}};

ErrorCode set(CommandContext& context, const Arguments& arguments) {
  const core::Axis axis = arguments.axis(kDof);
  const auto& configuration = context.system.configuration().axes[axis];
  if (arguments.given(kFeedForward)) {
    FeedForward model = configuration.feed_forward;
    model.enabled = arguments.choice(kFeedForward) == 0;
    const core::Status status = context.system.set_feed_forward(axis, model);
    if (!status) {
      return explained(context, status.error());
    }
  }
  context.out.text(core::name_of(axis)).text(": PID, feed-forward ");
  context.out.text(configuration.feed_forward.enabled ? "on" : "off").end_line();
  return ErrorCode::kNone;
}

}  // namespace law

namespace qei {

enum Option : std::size_t { kDof, kMethod, kOptionCount };
constexpr std::array<OptionSpec, kOptionCount> kOptions{{
    kDofRequired,
    {.name = "--velocity",
     .kind = OptionKind::kChoice,
     .presence = Presence::kOptional,
     .choices = "frequency|period|hybrid",
     .meaning = "how speed is found from counts and edge times"},
}};

ErrorCode set(CommandContext& context, const Arguments& arguments) {
  const core::Axis axis = arguments.axis(kDof);
  if (arguments.given(kMethod)) {
    const core::Status status = context.system.set_velocity_method(
        axis, static_cast<VelocityMethod>(arguments.choice(kMethod)));
    if (!status) {
      return explained(context, status.error());
    }
  }
  const auto& configuration = context.system.configuration().axes[axis];
  const auto method = static_cast<std::size_t>(configuration.velocity.method);
  context.out.text(core::name_of(axis)).text(": velocity ");
  context.out.text(names_of(configuration.velocity.method)[method]).text(", ");
  context.out.fixed(configuration.counts_per_m(), 1).text(" counts/m").end_line();
  return ErrorCode::kNone;
}

}  // namespace qei

namespace timers {

enum Option : std::size_t { kRate, kOptionCount };
constexpr std::array<OptionSpec, kOptionCount> kOptions{{
    {.name = "--rate",
     .presence = Presence::kOptional,
     .dimension = Dimension::kFrequency,
     .bare_unit = "Hz",
     .range = core::between(1, 5000),
     .meaning = "control ticks a second; the period must be a multiple of 0.1ms"},
}};

ErrorCode set(CommandContext& context, const Arguments& arguments) {
  if (arguments.given(kRate)) {
    const core::Status status = context.system.set_control_rate(arguments.number(kRate));
    if (!status) {
      return explained(context, status.error());
    }
  }
  context.out.text("control rate ").compact(context.system.configuration().control_rate_Hz, 6);
  context.out.text("Hz").end_line();
  return ErrorCode::kNone;
}

}  // namespace timers

namespace console {

enum Option : std::size_t { kEcho, kOptionCount };
constexpr std::array<OptionSpec, kOptionCount> kOptions{{
    {.name = "--echo",
     .kind = OptionKind::kChoice,
     .presence = Presence::kRequired,
     .choices = kOnOff,
     .meaning = "off for scripts: nothing comes back of what is typed"},
}};

ErrorCode set(CommandContext& context, const Arguments& arguments) {
  context.settings.echo = arguments.choice(kEcho) == 0;
  return ErrorCode::kNone;
}

}  // namespace console
}  // namespace

std::span<const CommandSpec> config_commands() noexcept {
  static constexpr std::array<CommandSpec, 5> kCommands{{
      {.word = "config",
       .sub = "gains",
       .options = gains::kOptions,
       .handler = gains::set,
       .meaning = "shows and sets the PID gains"},
      {.word = "config",
       .sub = "law",
       .options = law::kOptions,
       .handler = law::set,
       .meaning = "shows and sets what is added to the PID"},
      {.word = "config",
       .sub = "qei",
       .options = qei::kOptions,
       .handler = qei::set,
       .meaning = "shows and sets the encoder's evaluation"},
      {.word = "config",
       .sub = "timers",
       .options = timers::kOptions,
       .handler = timers::set,
       .meaning = "shows and sets the control rate"},
      {.word = "config",
       .sub = "console",
       .options = console::kOptions,
       .handler = console::set,
       .meaning = "sets the echo"},
  }};
  return kCommands;
}

}  // namespace towbench::bbmc
