#include "bbmc/system/device_io.h"

#include "core/check.h"

namespace towbench::bbmc {
namespace {

using core::Axis;

// After start() a device call of the control path can fail by a bug only.
void must(const core::Status& status) noexcept {
  core::check(status.has_value());
}

template <typename DriverType>
core::Status open_and_init(DriverType& driver,
                           const typename DriverType::Settings& settings) noexcept {
  if (auto opened = driver.open(); !opened) {
    return opened;
  }
  return driver.init(settings);
}

}  // namespace

core::Status DeviceIo::start(const Configuration& configuration) noexcept {
  for (Axis which : kAxes) {
    exists_[which] = configuration.axes[which].exists;
    if (!exists_[which]) {
      continue;
    }
    if (auto status = start_axis(which, configuration.axes[which]); !status) {
      return status;
    }
  }
  if (auto status = start_lines(); !status) {
    return status;
  }
  if (auto status = open_and_init(devices_->interrupts(), {}); !status) {
    return status;
  }
  if (auto status = open_and_init(devices_->console(), {}); !status) {
    return status;
  }
  period_ns_ = configuration.control_period_ns();
  if (auto status = open_and_init(devices_->control_timer(), {.period_ns = period_ns_}); !status) {
    return status;
  }
  return devices_->control_timer().write({Dmtimer::Action::kStart});
}

core::Status DeviceIo::start_axis(Axis which, const AxisConfiguration& axis) noexcept {
  const auto period_ticks = static_cast<std::uint16_t>(axis.drive.pwm_period_ticks);
  if (auto status = open_and_init(devices_->pwm(which), {.period_ticks = period_ticks}); !status) {
    return status;
  }
  return open_and_init(devices_->encoder(which),
                       {.capture_clock_Hz = axis.velocity.capture_clock_Hz});
}

core::Status DeviceIo::start_lines() noexcept {
  for (std::size_t i = 0; i < kLineCount; ++i) {
    const Line line = static_cast<Line>(i);
    const Gpio::Settings settings{.output = !is_input(line), .interrupt_on_edges = is_input(line)};
    if (auto status = open_and_init(devices_->line(line), settings); !status) {
      return status;
    }
  }
  return {};
}

core::Status DeviceIo::set_period(core::Nanoseconds period_ns) noexcept {
  auto status = devices_->control_timer().config({.period_ns = period_ns});
  if (status) {
    period_ns_ = period_ns;
  }
  return status;
}

core::Status DeviceIo::set_pwm_period(Axis which, std::int64_t ticks) noexcept {
  return devices_->pwm(which).config({.period_ticks = static_cast<std::uint16_t>(ticks)});
}

bool DeviceIo::next_interrupt(Aintc::Reading& edge) noexcept {
  return devices_->interrupts().read(edge).has_value();
}

void DeviceIo::sample(core::Nanoseconds now_ns, ControlSample& sample) noexcept {
  sample.time_ns = now_ns;
  for (Axis which : kAxes) {
    if (exists_[which]) {
      must(devices_->encoder(which).read(sample.encoder[which]));
    }
  }
  sample.lines = 0;
  for (std::size_t i = 0; i < kInputLines; ++i) {
    const Line line = static_cast<Line>(i);
    Gpio::Reading level;
    must(devices_->line(line).read(level));
    if (level.active) {
      sample.lines = static_cast<std::uint16_t>(sample.lines | mask_of(line));
    }
  }
  DmtimerDriver& timer = devices_->control_timer();
  Dmtimer::Reading due;
  must(timer.read(due));
  sample.tick_due = due.running && now_ns >= due.next_due_ns;
  sample.ticks_missed = 0;
  sample.tick_due_ns = due.next_due_ns;
  if (!sample.tick_due) {
    return;
  }
  // One tick is computed for all that are pending; the others are counted, not made up for.
  must(timer.write({Dmtimer::Action::kAcknowledge}));
  must(timer.read(due));
  while (now_ns >= due.next_due_ns) {
    ++sample.ticks_missed;
    must(timer.write({Dmtimer::Action::kAcknowledge}));
    must(timer.read(due));
  }
}

void DeviceIo::drive(const DriveCommand& command) noexcept {
  for (Axis which : kAxes) {
    if (!exists_[which]) {
      continue;
    }
    const AxisDrive& wanted = command.axes[which];
    const bool changed = !(wanted == written_[which]);
    if (changed || (command.tick && wanted.enable)) {
      write(which, wanted);
    }
  }
}

void DeviceIo::write(Axis which, const AxisDrive& drive) noexcept {
  GpioDriver& enable = devices_->line(amplifier_enable_of(which));
  // Power goes on before duty and off after it, so that no duty meets a half-enabled amplifier.
  if (drive.enable && !written_[which].enable) {
    must(enable.write({.active = true}));
  }
  const std::int32_t ticks = drive.enable ? drive.ticks : 0;
  must(devices_->pwm(which).write(
      {.channel_a_ticks = static_cast<std::uint16_t>(ticks > 0 ? ticks : 0),
       .channel_b_ticks = static_cast<std::uint16_t>(ticks < 0 ? -ticks : 0),
       .enable = drive.enable}));
  if (!drive.enable && written_[which].enable) {
    must(enable.write({.active = false}));
  }
  written_[which] = drive;
}

void DeviceIo::remove_drive() noexcept {
  for (Axis which : kAxes) {
    if (written_[which].enable) {
      write(which, {});
    }
  }
}

core::Nanoseconds DeviceIo::clock_ns() noexcept {
  Dmtimer::Reading reading;
  must(devices_->control_timer().read(reading));
  return reading.time_ns;
}

}  // namespace towbench::bbmc
