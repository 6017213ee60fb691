// The folded parts: every metric, and the console.
#include <fmt/format.h>

#include "harness/report/html.h"
#include "harness/report/quantity.h"
#include "harness/report/sections.h"

namespace towbench::harness::report {
namespace {

using Json = nlohmann::json;

// A console longer than this is cut in the page: what happened first and last matters most.
constexpr std::size_t kConsoleHead = 60'000;
constexpr std::size_t kConsoleTail = 60'000;

std::string metric_row(const Json& metric) {
  const std::string unit = text_at(metric, "unit");
  const std::optional<double> value = number_at(metric, "value");
  const std::optional<double> samples = number_at(metric, "samples");
  return fmt::format(
      "<tr data-metric=\"{}\" data-window=\"{}\"><td><code>{}</code><span class=\"meaning\">{}"
      "</span></td><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td></tr>\n",
      escaped(text_at(metric, "name")), escaped(text_at(metric, "window")),
      escaped(text_at(metric, "name")), escaped(text_at(metric, "meaning")),
      escaped(text_at(metric, "window")),
      value ? escaped(readable_quantity(*value, unit)) : std::string("no sample"),
      samples ? escaped(readable_number(*samples)) : std::string{});
}

std::string summary(int level, std::string_view title, const std::string& extent) {
  return fmt::format("<summary><h{0}>{1}</h{0}> <span class=\"note\">{2}</span></summary>\n", level,
                     escaped(title), escaped(extent));
}

}  // namespace

std::string metrics_section(const RunContents& run, int level) {
  if (!run.contradictions.empty()) {
    return "<section>\n" + heading(level, "All metrics") +
           missing_note("Not shown: the folder does not agree with itself.") + "</section>\n";
  }
  const Json& metrics = member(run.metrics, "metrics");
  if (!metrics.is_array() || metrics.empty()) {
    return "<section>\n" + heading(level, "All metrics") +
           missing_note("No metric was computed for this run.") + "</section>\n";
  }
  std::string html = "<details class=\"metrics\">\n";
  html += summary(level, "All metrics", fmt::format("{} values", metrics.size()));
  html +=
      "<table>\n<thead><tr><th>Metric</th><th>Window</th><th class=\"number\">Value</th>"
      "<th class=\"number\">Samples</th></tr></thead>\n<tbody>\n";
  for (const Json& metric : metrics) {
    html += metric_row(metric);
  }
  return html + "</tbody>\n</table>\n</details>\n";
}

std::string console_section(const RunContents& run, int level) {
  if (!run.console || run.console->empty()) {
    return "<section>\n" + heading(level, "Console") +
           missing_note(run.console ? "The console stayed silent." : "console.txt is missing.") +
           "</section>\n";
  }
  const std::string& text = *run.console;
  std::string shown = escaped(text);
  if (text.size() > kConsoleHead + kConsoleTail) {
    const std::size_t left_out = text.size() - kConsoleHead - kConsoleTail;
    shown = escaped(text.substr(0, kConsoleHead)) +
            fmt::format("\n\n[{} bytes left out here; console.txt has them]\n\n", left_out) +
            escaped(text.substr(text.size() - kConsoleTail));
  }
  return "<details class=\"console\">\n" +
         summary(level, "Console", fmt::format("{} bytes", text.size())) + "<pre tabindex=\"0\">" +
         shown + "</pre>\n</details>\n";
}

}  // namespace towbench::harness::report
