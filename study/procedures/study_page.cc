#include "study/procedures/study_page.h"

#include <fmt/format.h>

#include "harness/report/html.h"
#include "study/procedures/svg_plot.h"

namespace towbench::study::procedures {
namespace {

using harness::report::escaped;
using harness::report::heading;

constexpr const char* kStyle =
    "body{font-family:sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color:#222}"
    "table{border-collapse:collapse;margin:1rem 0}td,th{padding:.2rem .7rem;text-align:right;"
    "border-bottom:1px solid #ddd}td:first-child,th:first-child{text-align:left}"
    ".miss{color:#b00020;font-weight:bold}figure{margin:1.5rem 0}figcaption{color:#555}"
    "svg{width:100%;height:auto}";

std::string row_of(const std::vector<std::string>& cells, const char* tag) {
  std::string row = "<tr>";
  for (const auto& cell : cells) {
    row += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
  }
  return row + "</tr>\n";
}

std::string table_of(const ResultTable& table) {
  std::string text = heading(4, table.title) + "<table>\n" + row_of(table.head, "th");
  for (const auto& row : table.rows) {
    text += row_of(row, "td");
  }
  return text + "</table>\n";
}

std::string figure_of(const Figure& figure) {
  return fmt::format("<figure>{}<figcaption>{}. {}</figcaption></figure>\n", svg_plot(figure),
                     escaped(figure.title), escaped(figure.caption));
}

std::string recovery_table(const std::vector<Recovery>& recoveries) {
  if (recoveries.empty()) {
    return {};
  }
  std::string text = heading(2, "Against the emulated machine's own parameters") +
                     "<p>Set beside after everything had been estimated.</p>\n<table>\n" +
                     row_of({"quantity", "axis", "estimate", "truth", "error, %", "demand, %",
                             "interval, % wide", "covers"},
                            "th");
  for (const auto& each : recoveries) {
    const auto& e = each.estimate;
    const auto name = e.at ? fmt::format("{} at {:.3f}", e.quantity, *e.at) : e.quantity;
    text += fmt::format(
        "<tr{}><td>{}</td><td>{}</td><td>{:.5g}</td><td>{:.5g}</td><td>{:+.2f}</td><td>{:g}</td>"
        "<td>{:.2f}</td><td>{}</td></tr>\n",
        each.agrees && each.narrow ? "" : " class=\"miss\"", escaped(name), escaped(e.axis),
        e.value, each.truth, each.error_pct, each.tolerance_pct, each.width_pct,
        !e.no_interval.empty() ? "withheld"
        : each.covered         ? "yes"
                               : "no");
  }
  return text + "</table>\n";
}

std::string estimates_table(const identify::Estimates& estimates) {
  std::string text = heading(2, "Estimates") + "<table>\n" +
                     row_of({"quantity", "axis", "value", "95 %", "unit", "rests on"}, "th");
  for (const auto& e : estimates) {
    text += row_of({e.at ? fmt::format("{} at {:.3f}", e.quantity, *e.at) : e.quantity, e.axis,
                    fmt::format("{:.5g}", e.value),
                    e.no_interval.empty() ? fmt::format("{:.5g} .. {:.5g}", e.low, e.high)
                                          : "withheld: " + e.no_interval,
                    e.unit, e.procedure + ": " + e.rests_on},
                   "td");
  }
  return text + "</table>\n";
}

std::string step_section(const SequenceStep& step) {
  const auto& outcome = step.outcome;
  std::string text =
      heading(3, fmt::format("{} {}, axis {}", step.id, step.title, core::name_of(step.axis)));
  if (outcome.status != ProcedureOutcome::Status::kDone) {
    text += harness::report::missing_note(
        (outcome.status == ProcedureOutcome::Status::kRefused ? "Refused: " : "Failed: ") +
        outcome.reason);
  }
  for (const auto& each : outcome.withheld) {
    text += harness::report::missing_note(
        fmt::format("Withheld: {}: {}", each.quantity, each.no_interval));
  }
  for (const auto& table : outcome.tables) {
    text += table_of(table);
  }
  for (const auto& figure : outcome.figures) {
    text += figure_of(figure);
  }
  return text;
}

}  // namespace

std::string study_page(const std::string& title, const SequenceResult& result,
                       const std::vector<Recovery>& recoveries) {
  std::string page =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width\">" +
      fmt::format("<title>{}</title><style>{}</style></head><body>\n", escaped(title), kStyle) +
      heading(1, title);
  page += recovery_table(recoveries);
  page += heading(2, "Experiments");
  for (const auto& step : result.steps) {
    page += step_section(step);
  }
  page += estimates_table(result.estimates);
  return page + "</body></html>\n";
}

}  // namespace towbench::study::procedures
