// The controller wired to a plant, one exchange at a time (docs/decisions/0001-walls.md).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "bbmc/host/controller_node.h"
#include "core/result.h"
#include "core/time.h"
#include "harness/link/plant_end.h"
#include "harness/lockstep/bench_recorder.h"
#include "harness/lockstep/duty_watch.h"
#include "harness/lockstep/host_schedule.h"
#include "harness/lockstep/injection.h"
#include "harness/lockstep/steered_bench.h"
#include "protocol/tee_sink.h"

namespace towbench::harness {

class LockstepBench final : public SteeredBench {
 public:
  // Plant and recorder outlive this; without a recorder rows and console are thrown away.
  LockstepBench(const bbmc::Configuration& configuration, std::uint64_t rig_hash, PlantEnd& plant,
                BenchRecorder* recorder);

  // The host that the controller runs on: when it serves, and by which clock. Outlives this; before
  // start().
  void run_on(const HostSchedule& host) noexcept { host_ = &host; }

  // Handshake. Before anything else.
  [[nodiscard]] core::Status start() noexcept;

  // Serves the controller as of now() and returns what its console printed.
  std::string_view serve() noexcept;
  // Runs the plant to the next exchange. An error means that the plant is gone; the controller has
  // then been told and has removed its drive.
  [[nodiscard]] core::Status advance() noexcept;

  [[nodiscard]] bool inject(const Injection& injection) override;

  // Orderly end: drive off, Bye both ways.
  void finish() noexcept;

  [[nodiscard]] core::Nanoseconds now_ns() const noexcept override { return now_ns_; }
  [[nodiscard]] core::Nanoseconds exchange_ns() const noexcept override {
    return controller_.exchange_ns();
  }
  // How long the controller has commanded no drive on any axis, as the wire shows it.
  [[nodiscard]] core::Nanoseconds undriven_ns() const noexcept { return duty_watch_.undriven_ns(); }
  [[nodiscard]] bbmc::ControllerNode& controller() noexcept { return controller_; }

 private:
  void take_records() noexcept;
  // By its host's clock.
  [[nodiscard]] core::Nanoseconds controller_time_ns() const noexcept;

  PlantEnd& plant_;
  BenchRecorder* recorder_;
  bbmc::ControllerNode controller_;
  DutyWatch duty_watch_;
  protocol::TeeSink to_plant_;
  const HostSchedule* host_ = nullptr;
  HostSchedule unplanned_;
  core::Nanoseconds now_ns_ = 0;
  std::string console_;
};

}  // namespace towbench::harness
