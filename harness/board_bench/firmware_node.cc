#include "harness/board_bench/firmware_node.h"

#include <algorithm>
#include <utility>

#include "bbmc/baremetal/board_pins.h"

namespace towbench::harness {
namespace {

using bbmc::Line;

constexpr std::uint32_t kMostTicks = 0xFFFF;

// The bench's own BBMC finds every line where it looks for it, without a wiring file.
constexpr bool has_pin(const std::optional<BoardPin>& pin, Line line) {
  return pin && pin->bank == 1 && !pin->active_low &&
         pin->pin == bbmc::kLinePins[bbmc::index_of(line)];
}
constexpr bool suits_bbmc(const BoardWiring& wiring, core::Axis axis) {
  const auto& wires = wiring.axes[axis];
  return has_pin(wires.hall_min, bbmc::hall_min_of(axis)) &&
         has_pin(wires.hall_max, bbmc::hall_max_of(axis)) &&
         has_pin(wires.ready, bbmc::amplifier_ready_of(axis)) &&
         has_pin(wires.enable, bbmc::amplifier_enable_of(axis));
}
static_assert(suits_bbmc({}, core::Axis::kY) && suits_bbmc({}, core::Axis::kX) &&
              has_pin(BoardWiring{}.kill_switch, Line::kKillSwitch));

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
  board::Eqep& encoder = board_.encoder(wiring_.axes[message.axis].encoder);
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

void FirmwareNode::drive_pin(const std::optional<BoardPin>& pin, bool active,
                             core::Nanoseconds time_ns) {
  if (pin) {
    board_.gpio(pin->bank).drive(pin->pin, active != pin->active_low, time_ns);
  }
}

void FirmwareNode::on(const protocol::DigitalInputs& inputs) noexcept {
  const auto active = [&](Line line) { return is_set(inputs.lines, bbmc::index_of(line)); };
  for (const core::Axis axis : core::kPlanarAxes) {
    const auto& wires = wiring_.axes[axis];
    const bool low_end = active(bbmc::hall_min_of(axis));
    const bool high_end = active(bbmc::hall_max_of(axis));
    drive_pin(wires.hall_min, low_end, inputs.change_ns);
    drive_pin(wires.hall_max, high_end, inputs.change_ns);
    drive_pin(wires.ready, active(bbmc::amplifier_ready_of(axis)), inputs.change_ns);
    drive_pin(wires.hall, low_end || high_end, inputs.change_ns);
  }
  drive_pin(wiring_.kill_switch, active(Line::kKillSwitch), inputs.change_ns);
}

bool FirmwareNode::output_of(const BoardPin& pin) const {
  return board_.gpio(pin.bank).output(pin.pin) != pin.active_low;
}

FirmwareNode::Drive FirmwareNode::drive_of(core::Axis axis) noexcept {
  const AxisWiring& wires = wiring_.axes[axis];
  Drive drive;
  if (!board_.is_on()) {
    return drive;
  }
  // An enable line that nobody drives is pulled up.
  const auto& enable = wires.enable;
  drive.enable = !enable || !board_.gpio(enable->bank).drives(enable->pin) || output_of(*enable);
  board::PwmShare a = board_.pwm(wires.pwm).output(board::Ehrpwm::Output::kA);
  board::PwmShare b = board_.pwm(wires.pwm).output(board::Ehrpwm::Output::kB);
  std::uint32_t period = a.period_ticks;
  for (; period > kMostTicks; period /= 2) {
    a.high_ticks /= 2;
    b.high_ticks /= 2;
  }
  if (wires.channels_swapped) {
    std::swap(a, b);
  }
  if (wires.direction && board_.gpio(wires.direction->bank).has_chosen(wires.direction->pin)) {
    const bool to_max = output_of(*wires.direction);
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
  for (const core::Axis axis : core::kPlanarAxes) {
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
  for (const core::Axis axis : core::kPlanarAxes) {
    if (is_set(axes_mask_, core::index_of(axis))) {
      send(axis, {});
    }
  }
  plant_->on(protocol::DigitalOutputs{
      .lines = 0, .change_ns = plant_ns_, .sequence = outputs_sequence_++});
  plant_->on(protocol::Bye{.time_ns = plant_ns_});
}

}  // namespace towbench::harness
