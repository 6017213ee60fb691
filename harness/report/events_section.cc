#include <map>
#include <string>

#include <fmt/format.h>

#include "harness/report/event_words.h"
#include "harness/report/html.h"
#include "harness/report/quantity.h"
#include "harness/report/sections.h"

namespace towbench::harness::report {
namespace {

using Json = nlohmann::json;

// How often each kind occurs.
std::map<std::string, std::size_t> counts_by_kind(const RunContents& run) {
  std::map<std::string, std::size_t> counts;
  for (const Json& event : run.events) {
    ++counts[text_at(event, "kind")];
  }
  return counts;
}

bool is_routine(const std::string& kind, std::size_t count) {
  return count > kMaxOfRoutineKind &&
         (kind == "index_pulse" || kind == "duty_on" || kind == "duty_zero");
}

}  // namespace

std::vector<NumberedEvent> listed_events(const RunContents& run) {
  const std::map<std::string, std::size_t> counts = counts_by_kind(run);
  std::vector<NumberedEvent> listed;
  for (const Json& event : run.events) {
    const std::string kind = text_at(event, "kind");
    if (!is_routine(kind, counts.at(kind)) && listed.size() < kMaxEvents) {
      listed.push_back({listed.size() + 1, event});
    }
  }
  return listed;
}

std::string events_section(const RunContents& run, const std::vector<NumberedEvent>& events,
                           int level) {
  std::string html = "<section class=\"events\">\n" + heading(level, "Events");
  if (events.empty()) {
    html += missing_note("No event was recorded.");
  } else {
    html +=
        "<table>\n<thead><tr><th>No.</th><th class=\"number\">Time (s)</th><th>Side</th>"
        "<th>Axis</th><th>What happened</th></tr></thead>\n<tbody>\n";
    for (const NumberedEvent& numbered : events) {
      const Json& event = numbered.event;
      const std::optional<double> time_s = number_at(event, "time_s");
      html += fmt::format(
          "<tr><td data-label=\"No.\">{}</td><td data-label=\"Time (s)\" class=\"number\">{}</td>"
          "<td data-label=\"Side\">{}</td><td data-label=\"Axis\">{}</td>"
          "<td data-label=\"What\" class=\"what\">{}</td></tr>\n",
          numbered.number, time_s ? fmt::format("{:.4f}", *time_s) : "unknown",
          escaped(text_at(event, "side")), escaped(text_at(event, "axis")), event_words(event));
    }
    html += "</tbody>\n</table>\n";
  }
  std::size_t routine = 0;
  for (const auto& [kind, count] : counts_by_kind(run)) {
    if (is_routine(kind, count)) {
      routine += count;
      html += fmt::format(
          "<p class=\"note\">{} events \"{}\" are in events.jsonl and not listed here.</p>\n",
          count, escaped(kind));
    }
  }
  const std::size_t left_out = run.events.size() - routine - events.size();
  if (left_out > 0) {
    html += missing_note(fmt::format("{} later events are in events.jsonl only.", left_out));
  }
  return html + "</section>\n";
}

}  // namespace towbench::harness::report
