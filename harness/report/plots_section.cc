#include <fmt/format.h>

#include "harness/report/assets.h"
#include "harness/report/html.h"
#include "harness/report/sections.h"

namespace towbench::harness::report {

std::string plots_section(const PlotTable& table, std::size_t run_index, int level) {
  std::string html = "<section class=\"plots\">\n" + heading(level, "Plots");
  for (const std::string& remark : table.remarks) {
    html += table.columns.empty() ? missing_note(remark)
                                  : fmt::format("<p class=\"note\">{}</p>\n", escaped(remark));
  }
  if (table.columns.empty()) {
    return html + "</section>\n";
  }
  if (script_asset().text.empty()) {
    html += missing_note(
        "This build of the bench has no plotting script (TOWBENCH_REPORT_ASSETS is OFF), so the "
        "page has no plots. The numbers are in log.csv and truth.csv.");
    return html + "</section>\n";
  }
  html += "<noscript>" +
          missing_note("Scripts are switched off in this browser, so the plots are not drawn.") +
          "</noscript>\n";
  // The script fills this element from the data block of the same number.
  html += fmt::format("<div class=\"plot-host\" data-run=\"{}\" data-level=\"{}\"></div>\n",
                      run_index, level + 1);
  return html + "</section>\n";
}

}  // namespace towbench::harness::report
