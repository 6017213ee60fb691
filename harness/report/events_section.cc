#include <algorithm>

#include <fmt/format.h>

#include "harness/report/event_words.h"
#include "harness/report/html.h"
#include "harness/report/quantity.h"
#include "harness/report/sections.h"

namespace towbench::harness::report {
namespace {

using Json = nlohmann::json;

bool is_index_pulse(const Json& event) {
  return text_at(event, "kind") == "index_pulse";
}

}  // namespace

std::vector<NumberedEvent> listed_events(const RunContents& run) {
  std::vector<NumberedEvent> listed;
  for (const Json& event : run.events) {
    if (!is_index_pulse(event) && listed.size() < kMaxEvents) {
      listed.push_back({listed.size() + 1, event});
    }
  }
  return listed;
}

std::string events_section(const RunContents& run, const std::vector<NumberedEvent>& events,
                           int level) {
  std::string html = "<section class=\"events\">\n" + heading(level, "Events");
  const auto pulses =
      static_cast<std::size_t>(std::count_if(run.events.begin(), run.events.end(), is_index_pulse));
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
  const std::size_t left_out = run.events.size() - pulses - events.size();
  if (left_out > 0) {
    html += missing_note(fmt::format("{} later events are in events.jsonl only.", left_out));
  }
  if (pulses > 0) {
    html += fmt::format(
        "<p class=\"note\">{} index pulses of the encoders are in events.jsonl and not listed "
        "here.</p>\n",
        pulses);
  }
  return html + "</section>\n";
}

}  // namespace towbench::harness::report
