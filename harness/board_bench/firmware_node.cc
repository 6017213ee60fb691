#include "harness/board_bench/firmware_node.h"

#include <algorithm>

namespace towbench::harness {
namespace {

using bbmc::Line;

constexpr std::uint32_t kMostTicks = 0xFFFF;

constexpr bool is_set(std::uint32_t bits, std::size_t n) noexcept {
  return (bits >> n & 1U) != 0;
}

}  // namespace

void FirmwareNode::greet() noexcept {
  plant_->on(protocol::Hello{.version = protocol::kProtocolVersion,
                             .role = protocol::Role::kController,
                             .axes_mask = axes_mask_,
                             .tick_ns = static_cast<std::uint32_t>(core::kPlantTick_ns),
                             .exchange_ns = static_cast<std::uint32_t>(core::kPlantTick_ns),
                             .capabilities = protocol::kCapabilityEdges,
                             .fixture_hash = hash_});
}

void FirmwareNode::on(const protocol::HelloReply& reply) noexcept {
  agreed_ = reply.refusal == core::ErrorCode::kNone ? core::Status{} : core::failure(reply.refusal);
}

void FirmwareNode::on(const protocol::EncoderEdges& message) noexcept {
  board::Eqep& encoder = board_.encoder(wiring_.axes[message.axis].subsystem);
  if (!encoder_known_[message.axis]) {
    encoder_known_[message.axis] = true;
    encoder.set_levels(message.start_levels);
  }
  core::Nanoseconds time_ns = message.start_ns;
  for (const protocol::EncoderEdge edge : message.edges) {
    time_ns += edge.step_ns();
    encoder.push_edge(static_cast<board::EncoderLine>(edge.line()), time_ns);
  }
}

void FirmwareNode::drive_pin(Line line, std::uint16_t lines, core::Nanoseconds time_ns) {
  const bool high = is_set(lines, bbmc::index_of(line));
  board_.gpio(wiring_.bank).drive(bbmc::kLinePins[bbmc::index_of(line)], high, time_ns);
}

void FirmwareNode::on(const protocol::DigitalInputs& inputs) noexcept {
  static_assert(static_cast<int>(protocol::InputLine::kKillSwitch) ==
                static_cast<int>(Line::kKillSwitch));
  for (std::size_t i = 0; i < bbmc::kInputLines; ++i) {
    drive_pin(static_cast<Line>(i), inputs.lines, inputs.change_ns);
  }
  for (const core::Axis axis : core::kAxes) {
    const bool either = is_set(inputs.lines, bbmc::index_of(bbmc::hall_min_of(axis))) ||
                        is_set(inputs.lines, bbmc::index_of(bbmc::hall_max_of(axis)));
    board_.gpio(wiring_.bank).drive(wiring_.axes[axis].hall_pin, either, inputs.change_ns);
  }
}

FirmwareNode::Drive FirmwareNode::drive_of(core::Axis axis) noexcept {
  const AxisWiring& wires = wiring_.axes[axis];
  const board::Gpio& pins = board_.gpio(wiring_.bank);
  const unsigned enable_pin = bbmc::kLinePins[bbmc::index_of(bbmc::amplifier_enable_of(axis))];
  Drive drive;
  if (!board_.is_on()) {
    return drive;
  }
  // An enable line that nobody drives is pulled up.
  drive.enable = !pins.drives(enable_pin) || pins.output(enable_pin);
  board::PwmShare a = board_.pwm(wires.subsystem).output(board::Ehrpwm::Output::kA);
  board::PwmShare b = board_.pwm(wires.subsystem).output(board::Ehrpwm::Output::kB);
  std::uint32_t period = a.period_ticks;
  for (; period > kMostTicks; period /= 2) {
    a.high_ticks /= 2;
    b.high_ticks /= 2;
  }
  if (pins.has_chosen(wires.direction_pin)) {
    const bool to_max = pins.output(wires.direction_pin) == wiring_.direction_high_is_max;
    const std::uint32_t size = a.high_ticks != 0 ? a.high_ticks : b.high_ticks;
    a.high_ticks = to_max ? size : 0;
    b.high_ticks = to_max ? 0 : size;
  }
  // Both channels at once push against each other: what is left is the difference.
  const std::uint32_t common = std::min(a.high_ticks, b.high_ticks);
  drive.a = static_cast<std::uint16_t>(a.high_ticks - common);
  drive.b = static_cast<std::uint16_t>(b.high_ticks - common);
  drive.period = static_cast<std::uint16_t>(std::max(period, 1U));
  return drive;
}

void FirmwareNode::send(core::Axis axis, const Drive& drive) noexcept {
  plant_->on(protocol::PwmDuty{.axis = axis,
                               .enable = drive.enable,
                               .channel_a_ticks = drive.a,
                               .channel_b_ticks = drive.b,
                               .period_ticks = drive.period,
                               .sequence = duty_sequence_[axis]++});
  sent_[axis] = drive;
}

void FirmwareNode::send_outputs() noexcept {
  std::uint16_t outputs = 0;
  for (const core::Axis axis : core::kAxes) {
    if (!is_set(axes_mask_, core::index_of(axis))) {
      continue;
    }
    const Drive drive = drive_of(axis);
    if (!anything_sent_ || !(drive == sent_[axis])) {
      send(axis, drive);
    }
    outputs =
        static_cast<std::uint16_t>(outputs | (drive.enable ? 1U << core::index_of(axis) : 0U));
  }
  if (!anything_sent_ || outputs != outputs_) {
    outputs_ = outputs;
    plant_->on(protocol::DigitalOutputs{
        .lines = outputs, .change_ns = plant_ns_, .sequence = outputs_sequence_++});
  }
  anything_sent_ = true;
}

bool FirmwareNode::drives() const noexcept {
  return std::any_of(sent_.begin(), sent_.end(), [](const Drive& drive) {
    return drive.enable && (drive.a != 0 || drive.b != 0);
  });
}

double FirmwareNode::duty_pct(core::Axis axis) const noexcept {
  const Drive& drive = sent_[axis];
  return drive.enable ? 100.0 * (drive.a - drive.b) / drive.period : 0.0;
}

void FirmwareNode::say_bye() noexcept {
  if (ended_ || plant_ == nullptr) {
    return;
  }
  ended_ = true;
  for (const core::Axis axis : core::kAxes) {
    if (is_set(axes_mask_, core::index_of(axis))) {
      send(axis, {});
    }
  }
  plant_->on(protocol::DigitalOutputs{
      .lines = 0, .change_ns = plant_ns_, .sequence = outputs_sequence_++});
  plant_->on(protocol::Bye{.time_ns = plant_ns_});
}

}  // namespace towbench::harness
