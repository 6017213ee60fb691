// Somebody who observes while a run is recorded. Called on the bench's own thread: takes a copy and
// returns; what it cannot take it loses, the record does not.
#pragma once

#include <filesystem>
#include <string_view>

#include "bbmc/host/controller_node.h"
#include "core/axis.h"
#include "core/time.h"
#include "emulator/plant_node.h"
#include "harness/lockstep/log_row.h"
#include "protocol/message_sink.h"

namespace towbench::harness {

class RunTap {
 public:
  RunTap() = default;
  RunTap(const RunTap&) = delete;
  RunTap& operator=(const RunTap&) = delete;
  virtual ~RunTap() = default;

  // The run's folder exists, nothing has been recorded.
  virtual void begins(const std::filesystem::path& /*folder*/) {}
  // Who hears what the controller hears, before it does. Null: nobody cares.
  [[nodiscard]] virtual protocol::MessageSink* witness() noexcept { return nullptr; }

  // `edges`: as the row's own control tick knew them.
  virtual void row(const LogRow& row, const core::PerAxis<bbmc::EdgeTimes>& edges) noexcept = 0;
  // Not of a plant in another process: its record is what there is of it.
  virtual void truth(const emulator::TruthRow& row) noexcept = 0;
  virtual void exchange(core::Nanoseconds took_ns) noexcept = 0;
  // A line of events.jsonl, and what the console printed.
  virtual void event(std::string_view line) noexcept = 0;
  virtual void console(std::string_view text) noexcept = 0;
};

}  // namespace towbench::harness
