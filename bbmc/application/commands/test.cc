// test: what the devices say, unit by unit (OR-BBMC-2g). Reads only, nothing moves.
#include <array>

#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/shared_options.h"
#include "bbmc/device/device_manager.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

ErrorCode test_gpio(CommandContext& context, const Arguments& /*arguments*/) {
  for (std::size_t i = 0; i < kLineCount; ++i) {
    const auto line = static_cast<Line>(i);
    Gpio::Reading reading;
    if (const core::Status read = context.devices.line(line).read(reading); !read) {
      context.why.text(name_of(line));
      return read.error();
    }
    context.out.text(name_of(line)).column(14).text(is_input(line) ? "in   " : "out  ");
    context.out.text(reading.active ? "active" : "inactive").end_line();
  }
  return ErrorCode::kNone;
}

enum QeiOption : std::size_t { kQeiDof };
constexpr std::array<OptionSpec, 1> kQeiOptions{{kDofRequired}};

ErrorCode test_qei(CommandContext& context, const Arguments& arguments) {
  const core::Axis axis = arguments.axis(kQeiDof);
  Eqep::Reading reading;
  if (const core::Status read = context.devices.encoder(axis).read(reading); !read) {
    context.why.text("eqep ").text(core::name_of(axis));
    return read.error();
  }
  TextWriter& out = context.out;
  out.text("position ").integer(reading.position).text(", direction ");
  out.text(reading.forward ? "+" : "-").text(", edges ").integer(reading.edges).end_line();
  out.text("capture ").integer(reading.capture_ticks).text(" ticks, ");
  out.text(reading.capture_valid ? "valid" : "not valid").text(", since edge ");
  out.integer(reading.since_edge_ticks).text(" ticks").end_line();
  out.text("illegal transitions ").integer(reading.illegal_transitions).text(", index pulses ");
  out.integer(reading.index_pulses).text(", last at ").integer(reading.index_position).end_line();
  return ErrorCode::kNone;
}

ErrorCode test_pwm(CommandContext& context, const Arguments& arguments) {
  const core::Axis axis = arguments.axis(kQeiDof);
  Ehrpwm::Reading reading;
  if (const core::Status read = context.devices.pwm(axis).read(reading); !read) {
    context.why.text("ehrpwm ").text(core::name_of(axis));
    return read.error();
  }
  TextWriter& out = context.out;
  out.text("channel A ").integer(reading.channel_a_ticks).text(" ticks, B ");
  out.integer(reading.channel_b_ticks).text(" of ");
  out.integer(context.system.configuration().axes[axis].drive.pwm_period_ticks);
  out.text(", output ").text(reading.enable ? "enabled" : "disabled").end_line();
  return ErrorCode::kNone;
}

ErrorCode test_devices(CommandContext& context, const Arguments& /*arguments*/) {
  for (std::size_t i = 0; i < DeviceManager::kUnitCount; ++i) {
    const DeviceUnit unit = context.devices.unit(i);
    context.out.text(unit.device).text(" ").text(unit.unit).column(24);
    context.out.text(name_of(unit.state)).end_line();
  }
  return ErrorCode::kNone;
}

}  // namespace

std::span<const CommandSpec> test_commands() noexcept {
  static constexpr std::array<CommandSpec, 4> kCommands{{
      {.word = "test", .sub = "gpio", .handler = test_gpio, .meaning = "level of every line"},
      {.word = "test",
       .sub = "qei",
       .options = kQeiOptions,
       .handler = test_qei,
       .meaning = "registers of an encoder's decoder"},
      {.word = "test",
       .sub = "pwm",
       .options = kQeiOptions,
       .handler = test_pwm,
       .meaning = "what an axis's PWM puts out"},
      {.word = "test",
       .sub = "devices",
       .handler = test_devices,
       .meaning = "state of every unit of every device"},
  }};
  return kCommands;
}

}  // namespace towbench::bbmc
