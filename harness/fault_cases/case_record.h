// Everything that one run says, kept in memory: what the judge of faults looks at. Both sides'
// records plus what crossed between them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bbmc/host/controller_node.h"
#include "core/realtime.h"
#include "emulator/plant_node.h"
#include "harness/lockstep/bench_recorder.h"
#include "harness/lockstep/host_schedule.h"
#include "harness/lockstep/log_row.h"
#include "harness/lockstep/run_outcome.h"
#include "protocol/messages.h"

namespace towbench::harness {

// Lines as they reached the controller: changed at `change_ns`, there to be served at `served_ns`.
struct LineArrival {
  core::Nanoseconds served_ns = 0;
  core::Nanoseconds change_ns = 0;
  protocol::InputLines lines = 0;
};

// As the controller sent it.
struct DutyMessage {
  core::Nanoseconds time_ns = 0;
  core::Axis axis = core::kFirstAxis;
  double duty = 0;  // -1 .. 1
  bool enable = false;

  [[nodiscard]] bool drives() const noexcept { return enable && duty != 0.0; }
};

struct ConsoleText {
  core::Nanoseconds time_ns = 0;
  std::string text;
};

// What arrived at the controller during one exchange, as one number: two runs whose controllers
// heard the same have the same.
struct Arrivals {
  core::Nanoseconds time_ns = 0;
  std::uint64_t digest = 0;
};

// A row of truth.csv.
struct KeptTruth {
  KeptTruth(const emulator::TruthRow& row, bool has_further_axes)
      : time_ns(row.time_ns), axes(row.axes, has_further_axes), input_lines(row.input_lines) {}

  core::Nanoseconds time_ns = 0;
  KeptAxes<emulator::AxisTruth> axes;
  protocol::InputLines input_lines = 0;
};

class CaseRecord final : public BenchRecorder, public emulator::PlantObserver {
 public:
  std::vector<KeptTruth> truth;
  std::vector<emulator::PlantEvent> plant_events;  // without what the injector says of itself
  std::vector<LogRow> log;
  std::vector<bbmc::ControllerEvent> controller_events;
  std::vector<LineArrival> lines;
  std::vector<DutyMessage> duties;
  std::vector<Arrivals> arrivals;
  std::vector<ConsoleText> printed;
  std::vector<ConsoleText>
      typed_lines;  // by the operator, each with the time at which it could be heard
  RunOutcome outcome;
  // Rows and events of the log are BBMC's own. Of another controller they are the bench's, or there
  // are none.
  bool of_bbmc = true;
  bool has_further_axes = false;  // the machine

  // The controller's clock may be off: rows and events are kept by the bench's. Null: it is
  // right.
  void keep_time_of(const HostSchedule* host) noexcept { host_ = host; }

  void drain(bbmc::ControllerNode& controller) noexcept override;
  void console(std::string_view text) noexcept override;
  void typed(core::Nanoseconds time_ns, std::string_view text) noexcept override;
  void wire_event(core::Nanoseconds /*time_ns*/, std::string_view /*kind*/) noexcept override {}
  void timing(core::Nanoseconds time_ns, core::Nanoseconds /*host_ns*/,
              core::Nanoseconds /*exchange_ns*/) noexcept override {
    now_ns_ = time_ns;
  }
  void flush() noexcept override {}
  [[nodiscard]] std::uint64_t rows() const noexcept override { return log.size(); }
  [[nodiscard]] bool good() const noexcept override { return true; }

  void on_truth(const emulator::TruthRow& row) noexcept override {
    truth.emplace_back(row, has_further_axes);
  }
  void on_event(const emulator::PlantEvent& event) noexcept override;

  // First fault latched, or null.
  [[nodiscard]] const bbmc::ControllerEvent* first_fault() const noexcept;
  // The last truth row at or before a time; the first one when there is none.
  [[nodiscard]] const KeptTruth& truth_at(core::Nanoseconds time_ns) const noexcept;
  void sent(const DutyMessage& duty);
  // Whether any axis was, by the last command that it was sent.
  [[nodiscard]] bool driven_at(core::Nanoseconds time_ns) const noexcept;
  [[nodiscard]] std::string all_printed() const;
  // When the controller carried out a reset that the operator had asked for, at or after a time;
  // the end of time when it never did. A reset that nobody asked for is none.
  [[nodiscard]] core::Nanoseconds next_reset_ns(core::Nanoseconds from_ns) const noexcept;

 private:
  core::PerAxis<bool> commanded_{};  // ever
  std::string typing_;
  const HostSchedule* host_ = nullptr;
  core::Nanoseconds now_ns_ = 0;
};

// First moment at which plant or sensor signals of the two runs differ; -1 when they never do. What
// only the controller or the injector says does not count.
[[nodiscard]] core::Nanoseconds first_difference_ns(const CaseRecord& a, const CaseRecord& b);

}  // namespace towbench::harness
