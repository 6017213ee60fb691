// What one side's loop did in a run: the figures of realtime.json, the lines that are printed, and
// what is judged.
#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

#include "core/time.h"
#include "harness/realtime/tick_loop.h"

namespace towbench::harness {

struct DurationFigures {
  core::Nanoseconds min_ns = 0;
  core::Nanoseconds mean_ns = 0;
  core::Nanoseconds p50_ns = 0;
  core::Nanoseconds p99_ns = 0;
  core::Nanoseconds p999_ns = 0;
  core::Nanoseconds max_ns = 0;
  std::uint64_t max_at = 0;  // tick
};

struct TickSummary {
  std::string side;    // "emulator", "controller"
  std::string rights;  // RealtimeRights::text()
  core::Nanoseconds period_ns = 0;
  std::uint64_t ticks = 0;
  std::uint64_t overruns = 0;
  std::uint64_t most_behind = 0;
  std::uint64_t worst_tick = 0;
  std::uint32_t max_behind = 0;
  bool host_was_late = false;
  DurationFigures lateness;
  DurationFigures execution;
};

[[nodiscard]] DurationFigures figures_of(const DurationHistogram& histogram);
[[nodiscard]] TickSummary summarise(std::string side, std::string rights, const TickPolicy& policy,
                                    const TickRecord& record);

[[nodiscard]] nlohmann::json to_json(const DurationFigures& figures);
[[nodiscard]] nlohmann::json to_json(const TickSummary& summary);
// With every bin of the histograms.
[[nodiscard]] nlohmann::json to_json(const TickSummary& summary, const TickRecord& record);
// Throws nlohmann::json::exception for anything that to_json() did not write.
[[nodiscard]] TickSummary tick_summary_from(const nlohmann::json& json);
// Every bin that is not empty, as [microseconds, ticks].
[[nodiscard]] nlohmann::json bins_of(const DurationHistogram& histogram);

// In the manner of cyclictest: one line for lateness, one for execution.
[[nodiscard]] std::string text_of(const TickSummary& summary);

}  // namespace towbench::harness
