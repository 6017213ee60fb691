// An external controller wired to a plant.
//
// In lockstep it has the word, and time waits for it: at T the controller has the inputs up to T
// and the reference of T, sends its outputs and Advance{T + exchange}; the plant then runs under
// them. By the wall clock the plant goes on in each of its ticks and tells what it knows once an
// exchange; the same program then answers in time, or is late. A row of the log is the moment T:
// the reference, the count that the encoder's messages give, the duty in force from then on.
// Nothing in it is the controller's own word.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/plant_node.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/experiment/reference.h"
#include "harness/external/answer_watch.h"
#include "harness/external/count_watch.h"
#include "harness/external/edge_watch.h"
#include "harness/external/standstill_watch.h"
#include "harness/fault_cases/case_record.h"
#include "harness/link/link_faults.h"
#include "harness/lockstep/log_row.h"
#include "harness/lockstep/operator.h"
#include "harness/lockstep/run_outcome.h"
#include "harness/lockstep/script_loop.h"
#include "harness/realtime/report_thinner.h"
#include "harness/realtime/tick_loop.h"
#include "harness/record/firmware_recorder.h"
#include "harness/record/run_tap.h"
#include "protocol/carriers/turn_link.h"
#include "protocol/each_message.h"

namespace towbench::harness {

// The plant's side; all outlive the bench.
struct ExternalPlant {
  emulator::PlantNode& node;
  const StandstillWatch& standstill;  // that observes it
  protocol::MessageSink& heard;       // hears the controller before the plant does
};

// Who writes the run down; all outlive the bench.
struct ExternalRecord {
  FirmwareRecorder& recorder;
  CaseRecord* rows = nullptr;  // takes the rows as well
  RunTap* tap = nullptr;       // so does this
};

class ExternalBench final : public SteeredBench {
 public:
  // `faults` strike what crosses; `run_operator` may be null.
  ExternalBench(const ExperimentFixture& fixture, const ExternalPlant& plant,
                protocol::TurnLink& link, const std::vector<LinkFault>& faults,
                const ExternalRecord& record, Operator* run_operator = nullptr);

  // From the greeting that has come to Bye. A controller that is lost or ends by itself is told in
  // RunOutcome::script_failure: the run is complete, and the drive is off.
  [[nodiscard]] RunOutcome run(const protocol::Hello& hello, const LoopWatchers& watchers);
  // The same by the clock of a loop whose period is the plant's tick.
  [[nodiscard]] RunOutcome run_by_the_wall_clock(const protocol::Hello& hello, TickLoop& loop,
                                                 AnswerWatch& answers,
                                                 const LoopWatchers& watchers);

  // ---- what the operator may do ----
  [[nodiscard]] core::Nanoseconds now_ns() const noexcept override { return plant_.node.now_ns(); }
  [[nodiscard]] core::Nanoseconds exchange_ns() const noexcept override {
    return outcome_.exchange_ns;
  }
  [[nodiscard]] bool inject(const Injection& injection) override;
  // A controller that hears a heartbeat waits on.
  void wait_a_little() noexcept override;

 private:
  using HostClock = std::chrono::steady_clock;

  struct ToPlant final : protocol::EachMessage<ToPlant> {
    ToPlant(ExternalBench& owner, const std::vector<LinkFault>& faults)
        : bench(owner), disturber(faults, true) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      bench.plant_.heard.on(message);
      bench.note_one();
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
      if (bench.record_.tap != nullptr) {
        bench.edges_.on(message);
      }
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

  void note_one() noexcept;
  void end_exchange() noexcept;
  template <typename Message>
  void note(const Message& /*message*/) noexcept {}
  void note(const protocol::PwmDuty& duty) noexcept;
  // The row of log.csv, told to whoever observes the run.
  [[nodiscard]] LogRow take_row(core::Nanoseconds time_ns) noexcept;
  void send_reference(core::Nanoseconds time_ns) noexcept;
  [[nodiscard]] bool over(core::Nanoseconds time_ns) noexcept;
  // False when the plant refuses it.
  [[nodiscard]] bool greet(const protocol::Hello& hello);
  RunOutcome ended(HostClock::time_point start);
  void lose(core::ErrorCode why, const std::string& words);
  // True when it is said.
  [[nodiscard]] bool said_too_much();
  void take_operator_acts(core::Nanoseconds now_ns);
  // Whether the experiment itself has the operator's reset then.
  [[nodiscard]] bool is_planned(core::Nanoseconds reset_ns) const;
  void interrupt_if_asked(const LoopWatchers& watchers);
  void exchange_until_over(const LoopWatchers& watchers);
  void tick_until_over(TickLoop& loop, AnswerWatch& answers, const LoopWatchers& watchers);
  // What the plant's next tick is to begin with; false when the controller is gone.
  [[nodiscard]] bool hear_tick(AnswerWatch& answers);
  // Whether the controller says this and that, and never Advance.
  [[nodiscard]] bool time_stands();

  const ExperimentFixture& fixture_;
  ExternalPlant plant_;
  protocol::TurnLink& link_;
  ExternalRecord record_;
  Operator* operator_;
  ReferenceSchedule schedule_;
  ToPlant to_plant_;
  ToController to_controller_;
  CountWatch counts_;
  EdgeWatch edges_;  // of a run that is observed
  core::PerAxis<AxisCommand> commands_;
  bool wants_reference_ = false;
  bool ended_ = false;
  bool finished_ = false;       // by hand
  bool disturbed_ = false;      // by hand
  std::uint32_t messages_ = 0;  // in this exchange
  bool has_flooded_ = false;
  std::uint32_t heartbeats_ = 0;
  AnswerWatch* answers_ = nullptr;        // of a run by the wall clock
  std::optional<ReportThinner> thinner_;  // the same
  core::ErrorCode refusal_ = core::ErrorCode::kNone;
  core::Nanoseconds until_ns_ = 0;  // what the plant runs to
  core::Nanoseconds row_ns_ = -1;
  core::Nanoseconds advanced_to_ns_ = 0;
  HostClock::time_point advanced_;
  RunOutcome outcome_;
};

}  // namespace towbench::harness
