#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "harness/report/html.h"
#include "harness/report/limit_bar.h"
#include "harness/report/quantity.h"
#include "harness/report/sections.h"

namespace towbench::harness::report {
namespace {

using Json = nlohmann::json;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// "y_tracking_error_peak_m" with unit "m" reads "y tracking error peak".
std::string readable_name(std::string name, std::string_view unit) {
  std::string suffix = "_";
  for (const char character : unit) {
    suffix += character == '/' ? std::string("_per_") : std::string(1, character);
  }
  const bool has_unit = !unit.empty() && name.size() > suffix.size() &&
                        name.compare(name.size() - suffix.size(), suffix.size(), suffix) == 0;
  if (has_unit) {
    name.resize(name.size() - suffix.size());
  }
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string limits_text(std::optional<double> min, std::optional<double> max,
                        const DisplayUnit& unit) {
  const auto shown = [&unit](double limit) { return readable_number(limit * unit.per_si); };
  const std::string name = unit.name.empty() ? "" : fmt::format("\u00a0{}", unit.name);
  if (min && max) {
    return *min == *max ? fmt::format("= {}{}", shown(*min), name)
                        : fmt::format("{} … {}{}", shown(*min), shown(*max), name);
  }
  if (min || max) {
    return fmt::format("{} {}{}", min ? "≥" : "≤", shown(min ? *min : *max), name);
  }
  return "";
}

// A fraction of the nearer limit; absolute where that limit is 0.
std::string margin_text(const Json& check, std::optional<double> min, std::optional<double> max) {
  const std::optional<double> margin = number_at(check, "margin");
  if (!margin || (!min && !max) || min == max) {
    return "";  // an exact value is met or not, there is no more or less
  }
  const bool absolute = (min && *min == 0 && !max) || (max && *max == 0 && !min);
  if (absolute) {
    return readable_quantity(*margin, text_at(check, "unit"));
  }
  const std::string percent = readable_number(std::round(*margin * 1000) / 10);
  return fmt::format("{}\u00a0%", percent);
}

std::string cell(std::string_view label, std::string_view html, std::string_view css = "") {
  return fmt::format("<td data-label=\"{}\"{}>{}</td>\n", label,
                     css.empty() ? std::string{} : fmt::format(" class=\"{}\"", css), html);
}

std::string detail(std::string_view css, const std::string& text) {
  return text.empty() ? std::string{}
                      : fmt::format("<span class=\"{}\">{}</span>", css, escaped(text));
}

std::string check_row(const Json& check) {
  const std::string name = text_at(check, "name");
  const std::string window = text_at(check, "window");
  const std::string unit_si = text_at(check, "unit");
  const VerdictKind kind = kind_of(text_at(check, "verdict"));
  const std::optional<double> value = number_at(check, "value");
  const std::optional<double> min = number_at(check, "min");
  const std::optional<double> max = number_at(check, "max");
  const std::array all{value.value_or(kNone), min.value_or(kNone), max.value_or(kNone)};
  const DisplayUnit unit = display_unit(unit_si, all);

  std::string what = fmt::format("<strong>{}</strong>", escaped(readable_name(name, unit_si)));
  what += detail("window", window.empty() || window == "whole" ? "" : "window: " + window);
  what += detail("meaning", text_at(check, "meaning"));
  what += detail("reason", text_at(check, "reason"));
  what += detail("source", text_at(check, "source"));
  const std::string shown = value ? fmt::format("{}{}{}", readable_number(*value * unit.per_si),
                                                unit.name.empty() ? "" : "\u00a0", unit.name)
                                  : (min || max ? std::string("no sample") : std::string{});

  std::string row = fmt::format(
      "<tr class=\"{}\" data-metric=\"{}\" data-window=\"{}\"{}>\n", class_of(kind), escaped(name),
      escaped(window), value ? fmt::format(" data-value=\"{:.17g}\"", *value) : std::string{});
  row += cell("Verdict",
              fmt::format("<span class=\"chip {}\"><span aria-hidden=\"true\">{}</span> {}</span>",
                          class_of(kind), symbol_of(kind), word_of(kind)));
  row += cell("Check", what, "what");
  row += cell("Value", escaped(shown), "number value");
  row += cell("Allowed", escaped(limits_text(min, max, unit)), "number");
  row += cell("Margin", escaped(margin_text(check, min, max)), "number");
  row +=
      cell("Scale", value && min != max ? limit_bar({*value, min, max}) : std::string{}, "scale");
  return row + "</tr>\n";
}

}  // namespace

std::string checks_section(const RunContents& run, int level) {
  std::string html = "<section class=\"checks\">\n" + heading(level, "Budgets and checks");
  if (!run.contradictions.empty()) {
    return html + missing_note("Not shown: the folder does not agree with itself.") +
           "</section>\n";
  }
  const Json& checks = member(run.result, "checks");
  if (!checks.is_array() || checks.empty()) {
    return html + missing_note("No check was judged in this run.") + "</section>\n";
  }
  html +=
      "<table>\n<thead><tr><th>Verdict</th><th>Check</th><th class=\"number\">Value</th>"
      "<th class=\"number\">Allowed</th><th "
      "class=\"number\">Margin</th><th>Scale</th></tr></thead>\n"
      "<tbody>\n";
  for (const Json& check : checks) {
    html += check_row(check);
  }
  return html + "</tbody>\n</table>\n</section>\n";
}

}  // namespace towbench::harness::report
