// The parts of the page, each from the run's files to HTML. `level` is the rank of its heading.
//
// All words and numbers are written here, so that the page can be read (and searched, printed,
// spoken) without its script; the script adds the plots.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/report/plot_table.h"
#include "harness/report/run_contents.h"
#include "harness/report/verdict.h"

namespace towbench::harness::report {

// An event with the number under which the table and the plots show it.
struct NumberedEvent {
  std::size_t number = 0;
  nlohmann::json event;
};

// The first kMaxEvents, without the kinds that say little one by one (index pulses, the drive going
// on and off) where there are many of them.
inline constexpr std::size_t kMaxEvents = 400;
inline constexpr std::size_t kMaxOfRoutineKind = 6;
[[nodiscard]] std::vector<NumberedEvent> listed_events(const RunContents& run);

[[nodiscard]] std::string run_title(const RunContents& run);
[[nodiscard]] std::string verdict_section(const RunContents& run, const Verdict& verdict);
[[nodiscard]] std::string checks_section(const RunContents& run, int level);
// Each requirement's margin over time with its worst moment; empty where none was judged.
[[nodiscard]] std::string margins_section(const RunContents& run, int level);
[[nodiscard]] std::string plots_section(const PlotTable& table, std::size_t run_index, int level);
// Force against speed; empty without a force sensor.
[[nodiscard]] std::string force_section(const PlotTable& table, int level);
[[nodiscard]] std::string events_section(const RunContents& run,
                                         const std::vector<NumberedEvent>& events, int level);
[[nodiscard]] std::string console_section(const RunContents& run, int level);
[[nodiscard]] std::string metrics_section(const RunContents& run, int level);
[[nodiscard]] std::string timing_section(const RunContents& run, int level);
[[nodiscard]] std::string provenance_section(const RunContents& run, int level);

}  // namespace towbench::harness::report
