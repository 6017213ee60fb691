#include "harness/lockstep/lockstep_bench.h"

#include <array>

namespace towbench::harness {

LockstepBench::LockstepBench(const bbmc::Configuration& configuration, std::uint64_t rig_hash,
                             PlantEnd& plant, BenchRecorder* recorder)
    : plant_(plant),
      recorder_(recorder),
      controller_(configuration, rig_hash),
      duty_watch_(recorder),
      to_plant_(duty_watch_, plant.sink()) {
  plant_.connect(controller_);
  controller_.connect(to_plant_);
}

core::Status LockstepBench::start() noexcept {
  controller_.greet();
  auto status = plant_.wait_for(protocol::Turn::kHelloReply);
  if (status) {
    status = controller_.handshake();
  }
  if (!status) {
    return status;
  }
  // The plant's first line levels follow its reply. An exchange of no length brings them on every
  // carrier before the controller is first served: a switch that is pressed at time 0 is seen at 0.
  to_plant_.on(protocol::Advance{now_ns_});
  return plant_.wait_for(protocol::Turn::kAdvanced);
}

core::Nanoseconds LockstepBench::controller_time_ns() const noexcept {
  const auto planned_ns = host_ == nullptr ? 0 : host_->ahead_ns(now_ns_);
  return now_ns_ + planned_ns + unplanned_.ahead_ns(now_ns_);
}

std::string_view LockstepBench::serve() noexcept {
  if ((host_ == nullptr || host_->serves_at(now_ns_)) && unplanned_.serves_at(now_ns_)) {
    controller_.serve(controller_time_ns());
  }
  take_records();
  return console_;
}

core::Status LockstepBench::advance() noexcept {
  const core::Nanoseconds until_ns = now_ns_ + controller_.exchange_ns();
  to_plant_.on(protocol::Advance{until_ns});
  auto status = plant_.wait_for(protocol::Turn::kAdvanced);
  if (status && controller_.plant_time_ns() != until_ns) {
    status = core::failure(core::ErrorCode::kTimeNotMonotonic);
  }
  if (!status) {
    controller_.peer_lost(status.error());
    controller_.serve(controller_time_ns());
    take_records();
    return status;
  }
  now_ns_ = until_ns;
  return {};
}

bool LockstepBench::inject(const Injection& injection) {
  bool possible = true;
  for (const auto& event : injection.events) {
    possible = possible && plant_.happen(event);
  }
  for (const auto& fault : injection.link) {
    possible = possible && plant_.disturb(fault);
  }
  const auto& stalls = injection.host.stalls;
  unplanned_.stalls.insert(unplanned_.stalls.end(), stalls.begin(), stalls.end());
  const auto& steps = injection.host.steps;
  unplanned_.steps.insert(unplanned_.steps.end(), steps.begin(), steps.end());
  return possible;
}

void LockstepBench::finish() noexcept {
  controller_.say_bye();
  // A plant that is gone by now has nothing left to say.
  (void)plant_.wait_for(protocol::Turn::kBye);
  take_records();
}

void LockstepBench::take_records() noexcept {
  console_.clear();
  std::array<char, 1024> bytes{};
  while (const std::size_t count = controller_.read_console(bytes)) {
    console_.append(bytes.data(), count);
  }
  if (recorder_ != nullptr) {
    recorder_->console(console_);
    recorder_->drain(controller_);
    return;
  }
  bbmc::TelemetryRow row;
  while (controller_.next_row(row)) {
  }
  bbmc::ControllerEvent event;
  while (controller_.next_event(event)) {
  }
}

}  // namespace towbench::harness
