#include "tests/bbmc/support/machine.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace towbench::tests {

using core::Axis;

Machine::Machine(const Options& options)
    : exchange_ns_(bbmc::exchange_period_ns(options.configuration.control_period_ns())),
      log_storage_(bbmc::kDataLogRows),
      board_(std::make_unique<bbmc::EmulatedBoard>()),
      devices_(std::make_unique<bbmc::DeviceManager>(board_->ports())),
      system_(
          std::make_unique<bbmc::SystemManager>(options.configuration, *devices_, log_storage_)) {
  core::check(bbmc::inconsistency(options.configuration) == nullptr);
  emulator::RigParameters rig = options.rig;
  for (Axis axis : core::kPlanarAxes) {
    rig.axes[axis].start_m = options.start_m[axis];
  }
  plant_ = std::make_unique<emulator::PlantNode>(rig, 1, options.events, *this);
  plant_->connect(*this);
  unsigned axes = 0;
  for (Axis axis : core::kPlanarAxes) {
    axes |= rig.axes[axis].exists ? 1U << core::index_of(axis) : 0U;
  }
  plant_->on(protocol::Hello{.axes_mask = static_cast<std::uint8_t>(axes),
                             .tick_ns = static_cast<std::uint32_t>(core::kPlantTick_ns),
                             .exchange_ns = static_cast<std::uint32_t>(exchange_ns_),
                             .capabilities = protocol::kCapabilityEdges});
  core::check(system_->start().has_value());
  serve();
  if (options.calibrated) {
    for (Axis axis : core::kPlanarAxes) {
      const double counts = options.start_m[axis] * options.configuration.axes[axis].counts_per_m();
      core::check(system_->calibrate_position(axis, static_cast<std::int64_t>(std::floor(counts)))
                      .has_value());
    }
  }
}

void Machine::serve() {
  board_->set_time(now_ns_);
  system_->service(now_ns_);
  board_->flush(tap_);
  bbmc::TelemetryRow row;
  while (system_->next_row(row)) {
    if (keep_records) {
      rows.push_back(row);
    }
  }
  bbmc::SystemEvent event;
  while (system_->next_event(event)) {
    events.push_back(event);
  }
}

void Machine::exchange() {
  plant_->on(protocol::Advance{now_ns_ + exchange_ns_});
  now_ns_ += exchange_ns_;
  serve();
}

void Machine::run_for(double duration_s) {
  const core::Nanoseconds until_ns = now_ns_ + core::nanoseconds(duration_s);
  while (now_ns_ < until_ns) {
    exchange();
  }
}

bool Machine::run_until_rest(double limit_s) {
  const core::Nanoseconds until_ns = now_ns_ + core::nanoseconds(limit_s);
  while (!system_->at_rest() && now_ns_ < until_ns) {
    exchange();
  }
  return system_->at_rest();
}

const bbmc::SystemEvent* Machine::find(bbmc::SystemEvent::Kind kind) const {
  const auto found = std::find_if(events.begin(), events.end(),
                                  [kind](const auto& event) { return event.kind == kind; });
  return found == events.end() ? nullptr : &*found;
}

void Machine::on(const protocol::HelloReply& reply) noexcept {
  core::check(reply.refusal == core::ErrorCode::kNone);
}

void Machine::on(const protocol::EncoderEdges& edges) noexcept {
  if (!disturb_edges) {
    core::check(board_->take(edges));
    return;
  }
  protocol::EncoderEdges disturbed = edges;
  disturb_edges(disturbed);
  static_cast<void>(board_->take(disturbed));
}

void Machine::on(const protocol::DigitalInputs& inputs) noexcept {
  core::check(board_->take(inputs));
}

void Machine::on_truth(const emulator::TruthRow& row) noexcept {
  if (keep_records) {
    truth.push_back(row);
  }
}

void Machine::on_event(const emulator::PlantEvent& event) noexcept {
  plant_events.push_back(event);
}

void Machine::Tap::on(const protocol::PwmDuty& duty) noexcept {
  if (machine_.keep_records) {
    machine_.duties.push_back({machine_.now_ns_, duty});
  }
  machine_.plant_->on(duty);
}

void Machine::Tap::on(const protocol::DigitalOutputs& outputs) noexcept {
  machine_.plant_->on(outputs);
}

}  // namespace towbench::tests
