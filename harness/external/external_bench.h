// An external controller wired to a plant, in lockstep: it has the word, and time waits for it.
//
// At T the controller has the inputs up to T and the reference of T, sends its outputs and
// Advance{T + exchange}; the plant then runs under them. A row of the log is the moment T: the
// reference, the count that the encoder's messages give, the duty as sent. Nothing in it is the
// controller's own word.
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "bbmc/system/telemetry_row.h"
#include "emulator/plant_node.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/experiment/reference.h"
#include "harness/external/count_watch.h"
#include "harness/external/standstill_watch.h"
#include "harness/fault_cases/case_record.h"
#include "harness/link/link_faults.h"
#include "harness/lockstep/run_outcome.h"
#include "harness/lockstep/script_loop.h"
#include "harness/record/firmware_recorder.h"
#include "protocol/carriers/turn_link.h"
#include "protocol/each_message.h"

namespace towbench::harness {

// The plant's side; all outlive the bench.
struct ExternalPlant {
  emulator::PlantNode& node;
  const StandstillWatch& standstill;  // that observes it
  protocol::MessageSink& heard;       // hears the controller before the plant does
};

class ExternalBench {
 public:
  // `faults` strike what crosses; `rows` takes the rows as well and may be null.
  ExternalBench(const ExperimentFixture& fixture, const ExternalPlant& plant,
                protocol::TurnLink& link, const std::vector<LinkFault>& faults,
                FirmwareRecorder& recorder, CaseRecord* rows);

  // From the greeting that has come to Bye. A controller that is lost or ends by itself is told in
  // RunOutcome::script_failure: the run is complete, and the drive is off.
  [[nodiscard]] RunOutcome run(const protocol::Hello& hello, const LoopWatchers& watchers);

 private:
  using HostClock = std::chrono::steady_clock;

  struct ToPlant final : protocol::EachMessage<ToPlant> {
    ToPlant(ExternalBench& owner, const std::vector<LinkFault>& faults)
        : bench(owner), disturber(faults, true) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      bench.plant_.heard.on(message);
      bench.note(message);
      disturber.pass(message, bench.plant_.node.now_ns());
    }
    void handle(const protocol::Advance& advance) noexcept;
    ExternalBench& bench;
    LinkDisturber disturber;
  };
  struct ToController final : protocol::EachMessage<ToController> {
    ToController(ExternalBench& owner, const std::vector<LinkFault>& faults)
        : bench(owner), disturber(faults, false) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      bench.counts_.on(message);
      disturber.pass(message, bench.until_ns_);
    }
    void handle(const protocol::HelloReply& reply) noexcept;
    void handle(const protocol::Advanced& advanced) noexcept;
    void handle(const protocol::Bye& bye) noexcept;
    ExternalBench& bench;
    LinkDisturber disturber;
  };
  struct AxisCommand {
    double duty = 0;  // -1 .. 1, 0 without the enable
    std::uint64_t edges_told = 0;
  };

  template <typename Message>
  void note(const Message& /*message*/) noexcept {}
  void note(const protocol::PwmDuty& duty) noexcept;
  void write_row(core::Nanoseconds time_ns) noexcept;
  void send_reference(core::Nanoseconds time_ns) noexcept;
  [[nodiscard]] bool over(core::Nanoseconds time_ns) noexcept;
  void exchange_until_over(const LoopWatchers& watchers);
  // Whether the controller says this and that, and never Advance.
  [[nodiscard]] bool time_stands();

  const ExperimentFixture& fixture_;
  ExternalPlant plant_;
  protocol::TurnLink& link_;
  FirmwareRecorder& recorder_;
  CaseRecord* rows_;
  ReferenceSchedule schedule_;
  ToPlant to_plant_;
  ToController to_controller_;
  CountWatch counts_;
  core::PerAxis<AxisCommand> commands_;
  bool wants_reference_ = false;
  bool ended_ = false;
  core::ErrorCode refusal_ = core::ErrorCode::kNone;
  core::Nanoseconds until_ns_ = 0;  // what the plant runs to
  core::Nanoseconds row_ns_ = -1;
  core::Nanoseconds advanced_to_ns_ = 0;
  HostClock::time_point advanced_;
  RunOutcome outcome_;
};

}  // namespace towbench::harness
