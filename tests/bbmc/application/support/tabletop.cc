#include "tests/bbmc/application/support/tabletop.h"

#include <algorithm>

namespace towbench::bbmc::testing {

Tabletop::Tabletop(const Configuration& configuration) : configuration_(configuration) {
  for (const core::Axis axis : core::kPlanarAxes) {
    pwm_[axis].board = this;
    pwm_[axis].axis = axis;
    encoder_[axis].board = this;
    encoder_[axis].axis = axis;
  }
  timer_.board = this;
  console_.board = this;
  interrupts_.board = this;
  for (std::size_t i = 0; i < kLineCount; ++i) {
    line_ports_[i].board = this;
    line_ports_[i].line = static_cast<Line>(i);
  }
}

BoardPorts Tabletop::ports() {
  BoardPorts ports;
  for (const core::Axis axis : core::kPlanarAxes) {
    ports.pwm[axis] = &pwm_[axis];
    ports.encoder[axis] = &encoder_[axis];
  }
  ports.control_timer = &timer_;
  for (std::size_t i = 0; i < kLineCount; ++i) {
    ports.lines[i] = &line_ports_[i];
  }
  ports.console = &console_;
  ports.interrupts = &interrupts_;
  return ports;
}

std::int64_t Tabletop::count(core::Axis axis) const {
  return static_cast<std::int64_t>(
      std::floor(axes_[axis].angle_rad / configuration_.axes[axis].rad_per_count()));
}

void Tabletop::advance(core::Nanoseconds step_ns) {
  for (const core::Nanoseconds end_ns = now_ns_ + step_ns; now_ns_ < end_ns;
       now_ns_ += core::kPlantTick_ns) {
    for (const core::Axis axis : core::kPlanarAxes) {
      axes_[axis].step(core::kPlantTick_s, configuration_.axes[axis]);
      const std::int64_t now = count(axis);
      edges_[axis] += static_cast<std::uint32_t>(std::abs(now - last_count_[axis]));
      last_count_[axis] = now;
    }
  }
}

void Tabletop::set_line(Line line, bool active) {
  bool& level = lines_[index_of(line)];
  if (level != active) {
    level = active;
    pending_.push_back({.time_ns = now_ns_, .line = line, .active = active});
  }
}

core::Status Tabletop::PwmPort::apply(const Ehrpwm::Settings& wanted) noexcept {
  settings = wanted;
  return {};
}
core::Status Tabletop::PwmPort::read(Ehrpwm::Reading& reading) noexcept {
  reading = output;
  return {};
}
core::Status Tabletop::PwmPort::write(const Ehrpwm::Command& command) noexcept {
  output = command;
  const double ticks =
      static_cast<double>(command.channel_a_ticks) - static_cast<double>(command.channel_b_ticks);
  board->axes_[axis].duty_ratio = command.enable ? ticks / settings.period_ticks : 0.0;
  return {};
}
void Tabletop::PwmPort::release() noexcept {
  output = {};
  board->axes_[axis].duty_ratio = 0;
}

core::Status Tabletop::EncoderPort::apply(const Eqep::Settings& wanted) noexcept {
  settings = wanted;
  return {};
}
core::Status Tabletop::EncoderPort::read(Eqep::Reading& reading) noexcept {
  const RigidAxis& state = board->axes_[axis];
  const double counts_per_s =
      std::fabs(state.speed_rad_per_s) / board->configuration_.axes[axis].rad_per_count();
  const double between_edges = settings.capture_clock_Hz / std::max(counts_per_s, 1e-3);
  reading.time_ns = board->now_ns_;
  reading.position = static_cast<std::uint32_t>(board->count(axis)) + offset;
  reading.capture_ticks =
      static_cast<std::uint32_t>(std::min(between_edges, 1.0 * kCaptureSaturation_ticks));
  reading.since_edge_ticks = reading.capture_ticks / 2;
  reading.capture_valid = between_edges < kCaptureSaturation_ticks;
  reading.forward = state.speed_rad_per_s >= 0;
  reading.edges = board->edges_[axis];
  return {};
}
core::Status Tabletop::EncoderPort::write(const Eqep::Command& command) noexcept {
  offset = command.position - static_cast<std::uint32_t>(board->count(axis));
  return {};
}

core::Status Tabletop::TimerPort::apply(const Dmtimer::Settings& wanted) noexcept {
  settings = wanted;
  return {};
}
core::Status Tabletop::TimerPort::read(Dmtimer::Reading& reading) noexcept {
  reading_.time_ns = board->now_ns_;
  reading = reading_;
  return {};
}
core::Status Tabletop::TimerPort::write(const Dmtimer::Command& command) noexcept {
  switch (command.action) {
    case Dmtimer::Action::kStart:
      reading_.running = true;
      reading_.next_due_ns = board->now_ns_;
      break;
    case Dmtimer::Action::kStop:
      reading_.running = false;
      break;
    case Dmtimer::Action::kAcknowledge:
      reading_.next_due_ns += settings.period_ns;
      ++reading_.ticks;
      break;
  }
  return {};
}

core::Status Tabletop::LinePort::apply(const Gpio::Settings& /*wanted*/) noexcept {
  return {};
}
core::Status Tabletop::LinePort::read(Gpio::Reading& reading) noexcept {
  reading.active = board->lines_[index_of(line)];
  return {};
}
core::Status Tabletop::LinePort::write(const Gpio::Command& command) noexcept {
  board->lines_[index_of(line)] = command.active;
  // This machine's amplifiers are ready as soon as they are enabled.
  for (const core::Axis axis : core::kPlanarAxes) {
    if (line == amplifier_enable_of(axis)) {
      board->set_line(amplifier_ready_of(axis), command.active);
    }
  }
  return {};
}

core::Status Tabletop::ConsolePort::apply(const Uart::Settings& /*wanted*/) noexcept {
  return {};
}
core::Status Tabletop::ConsolePort::read(Uart::Reading& reading) noexcept {
  reading.clear();
  std::string& waiting = board->to_controller;
  if (waiting.empty()) {
    return core::failure(core::ErrorCode::kDeviceNoData);
  }
  const std::size_t size = std::min(waiting.size(), Uart::kChunk);
  reading.assign(std::span<const char>(waiting).first(size));
  waiting.erase(0, size);
  return {};
}
core::Status Tabletop::ConsolePort::write(const Uart::Command& command) noexcept {
  if (board->from_controller.size() + command.size() > board->uart_room) {
    return core::failure(core::ErrorCode::kDeviceFull);
  }
  board->from_controller.append(command.begin(), command.end());
  return {};
}

core::Status Tabletop::InterruptPort::apply(const Aintc::Settings& /*wanted*/) noexcept {
  return {};
}
core::Status Tabletop::InterruptPort::read(Aintc::Reading& reading) noexcept {
  if (board->pending_.empty()) {
    return core::failure(core::ErrorCode::kDeviceNoData);
  }
  reading = board->pending_.front();
  board->pending_.pop_front();
  return {};
}
core::Status Tabletop::InterruptPort::write(const Aintc::Command& /*command*/) noexcept {
  return {};
}

}  // namespace towbench::bbmc::testing
