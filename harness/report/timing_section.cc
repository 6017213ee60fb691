#include <array>

#include <fmt/format.h>

#include "harness/report/histogram.h"
#include "harness/report/html.h"
#include "harness/report/quantity.h"
#include "harness/report/sections.h"

namespace towbench::harness::report {
namespace {

struct Column {
  const char* name;
  const char* meaning;
};

// What timing.csv may hold; lateness exists only where the clock is the host's.
constexpr std::array kColumns{
    Column{"exchange_us", "Host time of one exchange, both sides"},
    Column{"lateness_us", "Lateness of the tick"},
    Column{"execution_us", "Execution time of the tick"},
};

std::string row(const Column& column, const Distribution& d) {
  std::string html = fmt::format("<tr><td>{}</td>", column.meaning);
  for (const double value : {d.min, d.mean, d.p50, d.p99, d.p99_9, d.max}) {
    html += fmt::format("<td class=\"number\">{}</td>", escaped(readable_number(value)));
  }
  return html + fmt::format("<td class=\"number\">{}</td></tr>\n", d.samples);
}

}  // namespace

std::string timing_section(const RunContents& run, int level) {
  if (!run.timing) {
    return {};
  }
  std::string html = "<section class=\"timing\">\n" + heading(level, "Host timing");
  std::string rows;
  std::string pictures;
  for (const Column& column : kColumns) {
    const std::vector<double>* values = run.timing->find(column.name);
    const Distribution d = values == nullptr ? Distribution{} : distribution_of(*values);
    if (d.samples > 0) {
      rows += row(column, d);
      pictures +=
          fmt::format("<figure class=\"timing\"><figcaption>{}, µs</figcaption>{}</figure>\n",
                      column.meaning, histogram_svg(*values, "µs"));
    }
  }
  if (rows.empty()) {
    return html + missing_note("timing.csv holds no sample.") + "</section>\n";
  }
  html +=
      "<p class=\"note\">From the host's clock, in microseconds. The only numbers here that differ "
      "from one replay to the next.</p>\n"
      "<div class=\"wide\" tabindex=\"0\"><table>\n<thead><tr><th>What</th>"
      "<th class=\"number\">min</th><th class=\"number\">mean</th><th class=\"number\">p50</th>"
      "<th class=\"number\">p99</th><th class=\"number\">p99.9</th><th class=\"number\">max</th>"
      "<th class=\"number\">samples</th></tr></thead>\n<tbody>\n";
  return html + rows + "</tbody>\n</table></div>\n" + pictures + "</section>\n";
}

}  // namespace towbench::harness::report
