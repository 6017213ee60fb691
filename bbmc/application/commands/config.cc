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

enum Option : std::size_t {
  kDof,
  kFeedForward,
  kFriction,
  kObserver,
  kChain,
  kCrossCoupling,
  kOptionCount,
};

constexpr OptionSpec addition(std::string_view name, std::string_view meaning) noexcept {
  return {.name = name,
          .kind = OptionKind::kChoice,
          .presence = Presence::kOptional,
          .choices = kOnOff,
          .meaning = meaning};
}
constexpr std::array<OptionSpec, kOptionCount> kOptions{{
    kDofRequired,
    addition("--feed-forward", "torque of the identified model added to the PID law"),
    addition("--friction", "friction of the reference's speed, instead of the model's"),
    addition("--observer", "disturbance observer: takes off what the model leaves over"),
    addition("--chain", "reference leads by the chain's stretch; for smooth profiles"),
    addition("--cross-coupling", "of both axes: the error across a path pulls both back"),
}};

void switch_if_given(const Arguments& arguments, Option option, bool& part) noexcept {
  part = arguments.given(option) ? arguments.choice(option) == 0 : part;
}

void show(TextWriter& out, std::string_view name, bool on) noexcept {
  out.text(", ").text(name).text(on ? " on" : " off");
}

ErrorCode set(CommandContext& context, const Arguments& arguments) {
  const core::Axis axis = arguments.axis(kDof);
  const Configuration& configuration = context.system.configuration();
  AxisConfiguration parts = configuration.axes[axis];
  switch_if_given(arguments, kFeedForward, parts.feed_forward.enabled);
  switch_if_given(arguments, kFriction, parts.friction.enabled);
  switch_if_given(arguments, kObserver, parts.disturbance_observer.enabled);
  switch_if_given(arguments, kChain, parts.chain.enabled);
  CrossCouplingConfiguration coupling = configuration.cross_coupling;
  switch_if_given(arguments, kCrossCoupling, coupling.enabled);
  bool changes = false;
  for (std::size_t option = kFeedForward; option < kOptionCount; ++option) {
    changes = changes || arguments.given(option);
  }
  if (changes) {
    if (const core::Status status = context.system.set_law(axis, parts); !status) {
      return explained(context, status.error());
    }
    if (const core::Status status = context.system.set_cross_coupling(coupling); !status) {
      return explained(context, status.error());
    }
  }
  TextWriter& out = context.out;
  out.text(core::name_of(axis)).text(": PID");
  show(out, "feed-forward", parts.feed_forward.enabled);
  show(out, "friction", parts.friction.enabled);
  show(out, "observer", parts.disturbance_observer.enabled);
  show(out, "chain", parts.chain.enabled);
  show(out, "cross-coupling", coupling.enabled);
  out.end_line();
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

namespace pwm {

enum Option : std::size_t { kDof, kPeriod, kLimit, kOptionCount };
constexpr std::array<OptionSpec, kOptionCount> kOptions{{
    kDofRequired,
    {.name = "--period",
     .kind = OptionKind::kWhole,
     .presence = Presence::kOptional,
     .range = core::between(10, 65535),
     .meaning = "ticks of a PWM period; one tick is the step of the duty"},
    {.name = "--limit",
     .presence = Presence::kOptional,
     .dimension = Dimension::kDuty,
     .bare_unit = "%",
     .range = core::between(1, 100),
     .meaning = "largest duty written"},
}};

ErrorCode set(CommandContext& context, const Arguments& arguments) {
  const core::Axis axis = arguments.axis(kDof);
  const DriveConfiguration& now = context.system.configuration().axes[axis].drive;
  if (arguments.given(kPeriod) || arguments.given(kLimit)) {
    const std::int64_t period = arguments.given(kPeriod)
                                    ? static_cast<std::int64_t>(arguments.number(kPeriod))
                                    : now.pwm_period_ticks;
    const double limit = arguments.given(kLimit) ? arguments.number(kLimit) : now.duty_limit_pct;
    const core::Status status = context.system.set_drive(axis, period, limit);
    if (!status) {
      return explained(context, status.error());
    }
  }
  context.out.text(core::name_of(axis)).text(": period ").integer(now.pwm_period_ticks);
  context.out.text(" ticks, duty at most ").compact(now.duty_limit_pct, 3).text("%, torque ");
  context.out.fixed(1e3 * now.torque_limit_Nm(), 2).text("mNm").end_line();
  return ErrorCode::kNone;
}

}  // namespace pwm

namespace everything {

ErrorCode show(CommandContext& context, const Arguments& /*arguments*/) {
  context.report.start(ConfigReport());
  return ErrorCode::kNone;
}

}  // namespace everything

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
  static constexpr std::array<CommandSpec, 7> kCommands{{
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
       .sub = "pwm",
       .options = pwm::kOptions,
       .handler = pwm::set,
       .meaning = "shows and sets the PWM's period and largest duty"},
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
      {.word = "config",
       .sub = "show",
       .handler = everything::show,
       .meaning = "lists everything that is set, with its key"},
  }};
  return kCommands;
}

}  // namespace towbench::bbmc
