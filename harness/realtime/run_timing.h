// The loops of a run in real time with what belongs to them: rights, figures, files.
//
//   realtime_emulator.json    written by the emulator's process when it ends
//   realtime.json             both sides: figures and every bin of the histograms
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "bbmc/system/configuration.h"
#include "core/result.h"
#include "emulator/plant_node.h"
#include "harness/judge/judge.h"
#include "harness/realtime/realtime_budget.h"
#include "harness/realtime/realtime_plant.h"
#include "harness/realtime/realtime_rights.h"
#include "harness/realtime/tick_clock.h"
#include "harness/realtime/tick_loop.h"
#include "harness/realtime/tick_summary.h"
#include "protocol/carriers/turn_link.h"

namespace towbench::harness {

// Both sides take their rights when they are made, for the thread that makes them, and warn on
// stderr of what is refused.

class EmulatorTiming {
 public:
  // Without a folder nothing is written.
  explicit EmulatorTiming(std::filesystem::path folder);

  // As serve_plant_in_real_time(), and writes the file.
  [[nodiscard]] core::Status serve(emulator::PlantNode& plant, protocol::TurnLink& link,
                                   const protocol::Hello& hello, const PlantSurroundings& around);

  // For who serves the plant himself. Of the loop that has ended: its figures.
  [[nodiscard]] TickLoop& loop() noexcept { return *loop_; }
  [[nodiscard]] const TickRecord& record() const noexcept { return loop_->record(); }
  [[nodiscard]] TickSummary summary() const;

 private:
  std::filesystem::path folder_;
  RealtimeRights rights_;
  HostTickClock clock_;
  std::unique_ptr<TickLoop> loop_;
};

class ControllerTiming {
 public:
  ControllerTiming(std::filesystem::path folder, const bbmc::Configuration& configuration);

  // One tick an exchange.
  [[nodiscard]] TickLoop& loop() noexcept { return *loop_; }

  // Both sides have ended. Adds the checks, writes realtime.json, and returns the figures in words.
  // An emulator that left no figures makes the run INVALID.
  [[nodiscard]] std::string judge_into(Judgement& judgement, core::Nanoseconds control_period_ns,
                                       const RealtimeBudget& budget);

 private:
  std::filesystem::path folder_;
  RealtimeRights rights_;
  HostTickClock clock_;
  std::unique_ptr<TickLoop> loop_;
};

}  // namespace towbench::harness
