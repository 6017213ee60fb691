#include "study/diagnosis_page/page.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "harness/report/html.h"
#include "study/diagnose/headline.h"
#include "study/diagnosis_page/pictures.h"
#include "study/prediction/units.h"
#include "study/procedures/svg_plot.h"

namespace towbench::study::diagnosis_page {
namespace {

using diagnose::Diagnosis;
using diagnose::NamedCause;
using harness::report::escaped;
using harness::report::heading;

constexpr const char* kStyle =
    "body{font-family:sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color:#222}"
    "table{border-collapse:collapse;margin:1rem 0}td,th{padding:.2rem .7rem;text-align:left;"
    "border-bottom:1px solid #ddd;vertical-align:top}pre{background:#f4f4f4;padding:.8rem;"
    "white-space:pre-wrap}figure{margin:1.5rem 0}figcaption{color:#555}svg{width:100%;height:auto}";

using Row = std::vector<std::string>;

std::string table(const Row& head, const std::vector<Row>& rows) {
  const auto line = [](const Row& cells, const char* tag) {
    std::string out = "<tr>";
    for (const auto& cell : cells) {
      out += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
    }
    return out + "</tr>\n";
  };
  std::string out = "<table>\n" + line(head, "th");
  for (const Row& row : rows) {
    out += line(row, "td");
  }
  return out + "</table>\n";
}

std::string sizes_of(const NamedCause& cause) {
  std::string out;
  for (const auto& size : cause.sizes) {
    out += fmt::format("{}{} {:.4g}", out.empty() ? "" : ", ", size.name, size.ci95.value);
    if (!size.known) {
      out += fmt::format(" ± {:.2g}", 0.5 * (size.ci95.high - size.ci95.low));
    }
  }
  return out;
}

std::string causes(const Diagnosis& d) {
  std::vector<Row> rows;
  for (const NamedCause& cause : d.causes) {
    std::string alternatives;
    for (const auto& alternative : cause.alternatives) {
      alternatives += (alternatives.empty() ? "" : ", ") + alternative;
    }
    rows.push_back({cause.effect->name, cause.effect->cause, sizes_of(cause),
                    cause.p_value < 1e-300 ? "< 1e-300" : fmt::format("{:.1e}", cause.p_value),
                    fmt::format("{:.1f} % [{:.1f}, {:.1f}]", 100 * cause.gain99.value,
                                100 * cause.gain99.low, 100 * cause.gain99.high),
                    alternatives.empty() ? "none" : alternatives});
  }
  return rows.empty() ? "<p>None.</p>\n"
                      : table({"effect", "meaning", "size (95 %)", "p, corrected",
                               "own gain, cross-validated (99 %)", "cannot be told from"},
                              rows);
}

std::string parameters(const Diagnosis& d) {
  std::vector<Row> rows;
  for (const auto& shift : d.parameters) {
    std::string others;
    for (const auto& name : shift.indistinguishable_from) {
      others += (others.empty() ? "" : ", ") + name;
    }
    rows.push_back({shift.name, d.estimated ? "" : fmt::format("{:.5g}", shift.supplied),
                    fmt::format("{:.5g} [{:.5g}, {:.5g}]", shift.fitted.value, shift.fitted.low,
                                shift.fitted.high),
                    shift.unit,
                    d.estimated   ? "estimated"
                    : shift.moved ? "moved"
                                  : "as stated",
                    others});
  }
  return table({"parameter", "stated", "fitted (95 %)", "unit, load side", "is", "or else"}, rows);
}

// A model that stays has nothing to confirm: its refit moved nothing that matters, and what that
// moved in simulation is chance.
bool stays(const Diagnosis& d) {
  return std::find(d.verdicts.begin(), d.verdicts.end(), "model_adequate") != d.verdicts.end();
}

std::string confirmed(const Diagnosis& d) {
  if (stays(d)) {
    return "<p>Nothing was found that could be.</p>\n";
  }
  const diagnose::FreeRun& f = d.free_run;
  const auto mm = [of = units_of(d.context.stated)](double metres) {
    return fmt::format("{:.3g} {}", 1e3 * metres, of.thousandth);
  };
  std::vector<Row> rows;
  if (f.windows.count > 0) {
    rows.push_back({fmt::format("after {:g} s, {} windows", diagnose::kWindow_s, f.windows.count),
                    mm(f.windows.supplied_m), mm(f.refitted_m), mm(f.windows.extended_m)});
  }
  rows.push_back({"over the whole longest run", mm(f.whole_supplied_m), mm(f.whole_refitted_m),
                  mm(f.whole_extended_m)});
  if (d.emulated) {
    const diagnose::Emulated& e = *d.emulated;
    if (e.windows.count > 0) {
      rows.push_back({fmt::format("in the emulator, after {:g} s", diagnose::kWindow_s),
                      mm(e.windows.supplied_m), "", mm(e.windows.extended_m)});
    }
    rows.push_back({"in the emulator, over the whole longest run", mm(e.whole_supplied_m), "",
                    mm(e.whole_extended_m)});
  }
  return table({"distance from the measured place, rms", "as supplied", "refitted", "extended"},
               rows);
}

std::string not_testable(const Diagnosis& d) {
  std::vector<Row> rows;
  for (const auto& entry : d.not_testable) {
    rows.push_back({entry.effect, entry.why, entry.needs});
  }
  return rows.empty() ? "<p>Nothing.</p>\n" : table({"effect", "why", "needs"}, rows);
}

}  // namespace

std::string page(const std::string& title, const Diagnosis& d) {
  std::string out =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width\">" +
      fmt::format("<title>{}</title><style>{}</style></head><body>\n", escaped(title), kStyle) +
      heading(1, title) + "<pre>" + escaped(diagnose::headline(d)) + "</pre>\n";
  if (!logs::is_fatal(d.findings)) {
    out += heading(2, "Causes") + causes(d);
    out += heading(2, "Parameters") + parameters(d);
    out += heading(2, "Left to itself under the measured input") + confirmed(d);
    out += heading(2, "Pictures");
    for (const auto& figure : pictures(d)) {
      out +=
          fmt::format("<figure>{}<figcaption>{}. {}</figcaption></figure>\n",
                      procedures::svg_plot(figure), escaped(figure.title), escaped(figure.caption));
    }
    out += heading(2, "What this data cannot show") + not_testable(d);
  }
  return out + "</body></html>\n";
}

}  // namespace towbench::study::diagnosis_page
