#include "tests/bbmc/support/fake_board_machine.h"

#include "core/check.h"

namespace towbench::tests {
namespace {

using core::Axis;

constexpr std::uint64_t kTick_ns = 10;  // of a PWM period's ticks, as linux_devices.h has it

}  // namespace

FakeBoardMachine::FakeBoardMachine(FakeBoard& board, const emulator::RigParameters& rig,
                                   core::Nanoseconds exchange_ns)
    : board_(board), plant_(rig, 1, {}, *this), exchange_ns_(exchange_ns) {
  plant_.connect(*this);
  plant_.on(protocol::Hello{.axes_mask = 3,
                            .tick_ns = static_cast<std::uint32_t>(core::kPlantTick_ns),
                            .exchange_ns = static_cast<std::uint32_t>(exchange_ns_),
                            .capabilities = protocol::kCapabilityEdges});
  write_inputs();
}

void FakeBoardMachine::on(const protocol::HelloReply& reply) noexcept {
  core::check(reply.refusal == core::ErrorCode::kNone);
}

void FakeBoardMachine::on_event(const emulator::PlantEvent& event) noexcept {
  touched_a_hard_end =
      touched_a_hard_end || event.kind == emulator::PlantEventKind::kHardEndContact;
}

void FakeBoardMachine::read_outputs() {
  unsigned enables = 0;
  for (Axis axis : core::kPlanarAxes) {
    const auto ticks = [&](unsigned channel) {
      const bool on = board_.read(FakeBoard::pwm_file(axis, channel, "enable")) == 1;
      const auto duty_ns = board_.read(FakeBoard::pwm_file(axis, channel, "duty_cycle"));
      return static_cast<std::uint16_t>(on ? duty_ns / kTick_ns : 0);
    };
    const auto period_ns = board_.read(FakeBoard::pwm_file(axis, 0, "period"));
    const bool enabled = board_.read(FakeBoard::line_file(bbmc::amplifier_enable_of(axis))) == 1;
    plant_.on(protocol::PwmDuty{.axis = axis,
                                .enable = board_.read(FakeBoard::pwm_file(axis, 0, "enable")) == 1,
                                .channel_a_ticks = ticks(0),
                                .channel_b_ticks = ticks(1),
                                .period_ticks = static_cast<std::uint16_t>(period_ns / kTick_ns),
                                .sequence = sequence_});
    enables |= enabled ? 1U << core::index_of(axis) : 0U;
  }
  plant_.on(protocol::DigitalOutputs{
      .lines = static_cast<std::uint16_t>(enables), .change_ns = now_ns_, .sequence = sequence_});
  ++sequence_;
}

void FakeBoardMachine::write_inputs() {
  for (Axis axis : core::kPlanarAxes) {
    const std::int64_t count = truth.empty() ? 0 : truth.back().axes[axis].count;
    board_.write(FakeBoard::count_file(axis), static_cast<std::uint32_t>(count));  // it wraps
  }
  for (std::size_t i = 0; i < bbmc::kInputLines; ++i) {
    const auto line = static_cast<bbmc::Line>(i);
    const bool pressed = line == bbmc::Line::kKillSwitch && kill_pressed_;
    board_.write(FakeBoard::line_file(line), pressed || (inputs_ & (1U << i)) != 0 ? 1U : 0U);
  }
}

void FakeBoardMachine::step() {
  read_outputs();
  now_ns_ += exchange_ns_;
  plant_.on(protocol::Advance{now_ns_});
  write_inputs();
}

}  // namespace towbench::tests
