#include "bbmc/host/emulated_board.h"

namespace towbench::bbmc {

static_assert(static_cast<std::size_t>(protocol::InputLine::kAmplifierReadyX) ==
                  index_of(Line::kAmplifierReadyX),
              "input lines have the same numbers on the wire and on the board");
static_assert(protocol::kWiredInputLines == kInputLines);

EmulatedBoard::EmulatedBoard() noexcept {
  for (std::size_t i = 0; i < kLineCount; ++i) {
    line_ports_[i].attach(lines_, static_cast<Line>(i));
  }
}

BoardPorts EmulatedBoard::ports() noexcept {
  BoardPorts ports;
  for (core::Axis axis : kAxes) {
    ports.pwm[axis] = &pwm_[axis];
    ports.encoder[axis] = &encoder_[axis];
  }
  for (std::size_t i = 0; i < kLineCount; ++i) {
    ports.lines[i] = &line_ports_[i];
  }
  ports.control_timer = &timer_;
  ports.console = &console_;
  ports.interrupts = &interrupts_;
  return ports;
}

bool EmulatedBoard::take(const protocol::EncoderEdges& edges) noexcept {
  return core::is_planar(edges.axis) && encoder_[edges.axis].decoder().take(edges);
}

bool EmulatedBoard::take(const protocol::EncoderReport& report) noexcept {
  return core::is_planar(report.axis) && encoder_[report.axis].decoder().take(report);
}

bool EmulatedBoard::take(const protocol::DigitalInputs& inputs) noexcept {
  const bool good = !inputs_started_ || inputs.sequence == next_inputs_sequence_;
  inputs_started_ = true;
  next_inputs_sequence_ = inputs.sequence + 1;
  for (std::size_t i = 0; i < kInputLines; ++i) {
    const auto mask = static_cast<std::uint16_t>(1U << i);
    const bool active = (inputs.lines & mask) != 0;
    if (active == ((lines_.levels & mask) != 0)) {
      continue;
    }
    lines_.levels =
        static_cast<std::uint16_t>(active ? lines_.levels | mask : lines_.levels & ~mask);
    if ((lines_.interrupts_enabled & mask) != 0) {
      lines_.insert({.time_ns = inputs.change_ns, .line = static_cast<Line>(i), .active = active});
    }
  }
  return good;
}

void EmulatedBoard::flush(protocol::MessageSink& plant) noexcept {
  for (core::Axis axis : kAxes) {
    if (pwm_[axis].take_written()) {
      const Ehrpwm::Command& output = pwm_[axis].output();
      plant.on(protocol::PwmDuty{.axis = axis,
                                 .enable = output.enable,
                                 .channel_a_ticks = output.channel_a_ticks,
                                 .channel_b_ticks = output.channel_b_ticks,
                                 .period_ticks = pwm_[axis].period_ticks(),
                                 .sequence = pwm_sequence_[axis]++});
    }
  }
  if (lines_.outputs_written) {
    lines_.outputs_written = false;
    const auto level = [this](Line line) -> unsigned {
      return (static_cast<unsigned>(lines_.levels) >> index_of(line)) & 1U;
    };
    const unsigned outputs =
        level(Line::kAmplifierEnableY) *
            protocol::mask_of(protocol::OutputLine::kAmplifierEnableY) |
        level(Line::kAmplifierEnableX) * protocol::mask_of(protocol::OutputLine::kAmplifierEnableX);
    plant.on(protocol::DigitalOutputs{.lines = static_cast<std::uint16_t>(outputs),
                                      .change_ns = clock_.now_ns,
                                      .sequence = outputs_sequence_++});
  }
}

}  // namespace towbench::bbmc
