#include "harness/report/page.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "harness/report/assets.h"
#include "harness/report/base64.h"
#include "harness/report/html.h"
#include "harness/report/packed_columns.h"
#include "harness/report/plot_table.h"
#include "harness/report/quantity.h"
#include "harness/report/sections.h"
#include "harness/report/verdict.h"

namespace towbench::harness::report {
namespace {

using Json = nlohmann::json;

// What the plots of one page may take; the words around them are small beside it.
constexpr std::size_t kPlotBytes = 5'000'000;

// The rig's limits in the controller's frame, as the positions in the plots are.
Json shifted_limits(const Json& limits, const core::PerAxis<double>& offset_m) {
  Json shifted = Json::object();
  for (const core::Axis axis : core::kAllAxes) {
    const std::string name(core::name_of(axis));
    for (const char* key : {"hall_min_m", "hall_max_m", "hard_min_m", "hard_max_m"}) {
      if (const std::optional<double> limit = number_at(member(limits, name), key)) {
        shifted[name][key] = *limit + offset_m[axis];
      }
    }
    if (const Json& turns = member(member(limits, name), "turns"); turns.is_boolean()) {
      shifted[name]["turns"] = turns;
    }
  }
  return shifted;
}

// What the script needs and the words do not carry.
Json plot_data(const RunContents& run, const PlotTable& table,
               const std::vector<NumberedEvent>& events, std::size_t max_bytes) {
  Json marks = Json::array();
  for (const NumberedEvent& numbered : events) {
    const std::optional<double> time_s = number_at(numbered.event, "time_s");
    // What the wire carries shows in the duty itself.
    if (time_s && text_at(numbered.event, "side") != "wire") {
      marks.push_back({{"number", numbered.number},
                       {"time_s", *time_s},
                       {"kind", text_at(numbered.event, "kind")},
                       {"axis", text_at(numbered.event, "axis")},
                       {"text", text_at(numbered.event, "text")}});
    }
  }
  return {{"table", packed(table, max_bytes)},
          {"events", std::move(marks)},
          {"limits", shifted_limits(member(run.result, "limits"), table.frame_offset_m)},
          {"windows", member(run.metrics, "windows")}};
}

struct Parts {
  std::string body;
  std::string data;
};

void append_run(const RunContents& run, std::size_t index, int level, std::size_t max_bytes,
                Parts& parts) {
  const std::vector<NumberedEvent> events = listed_events(run);
  const PlotTable table = plot_table(run);
  parts.body += verdict_section(run, verdict_of(run));
  parts.body += plots_section(table, index, level);
  parts.body += force_section(table, level);
  parts.body += checks_section(run, level);
  parts.body += margins_section(run, level);
  parts.body += events_section(run, events, level);
  parts.body += metrics_section(run, level);
  parts.body += console_section(run, level);
  parts.body += timing_section(run, level);
  parts.body += provenance_section(run, level);
  if (!table.columns.empty() && !script_asset().text.empty()) {
    parts.data += fmt::format("<script type=\"application/json\" id=\"run-data-{}\">{}</script>\n",
                              index, script_json(plot_data(run, table, events, max_bytes)));
  }
}

std::string description_of(const RunContents& run) {
  const std::string text = text_at(member(run.result, "experiment"), "description");
  return text.empty() ? "" : fmt::format("<p class=\"lead\">{}</p>\n", escaped(text));
}

// Only the page's own script may run, and nothing may be fetched.
std::string security_policy(const Asset& script) {
  std::vector<std::uint8_t> digest;
  for (std::size_t i = 0; i + 1 < script.sha256_hex.size(); i += 2) {
    const auto digit = [&](std::size_t at) {
      const char c = script.sha256_hex[at];
      return static_cast<unsigned>(c >= 'a' ? c - 'a' + 10 : c - '0');
    };
    digest.push_back(static_cast<std::uint8_t>(digit(i) * 16U + digit(i + 1)));
  }
  return fmt::format(
      "default-src 'none'; style-src 'unsafe-inline'; img-src data:; script-src {}; base-uri "
      "'none'; form-action 'none'",
      script.text.empty() ? "'none'" : fmt::format("'sha256-{}'", base64(digest)));
}

// One pass over the template, so that nothing inserted is looked at again.
std::string filled(std::string_view text, const std::map<std::string_view, std::string>& values) {
  std::string page;
  while (!text.empty()) {
    const std::size_t open = text.find("{{");
    const std::size_t close = open == std::string_view::npos ? open : text.find("}}", open);
    if (close == std::string_view::npos) {
      page += text;
      break;
    }
    page += text.substr(0, open);
    const auto found = values.find(text.substr(open + 2, close - open - 2));
    page += found == values.end() ? std::string{} : found->second;
    text.remove_prefix(close + 2);
  }
  return page;
}

std::string document(const std::string& title, const Parts& parts) {
  const Asset script = script_asset();
  return filled(
      template_asset().text,
      {{"policy", security_policy(script)},
       {"title", escaped(title)},
       {"style", std::string(style_asset().text)},
       {"body", parts.body},
       {"data", parts.data},
       {"script", script.text.empty() ? std::string{}
                                      : "<script>" + std::string(script.text) + "</script>"}});
}

// The check that came nearest to its limit, or broke it most.
std::string worst_margin(const RunContents& run) {
  const Json& checks = member(run.result, "checks");
  std::optional<double> worst;
  std::string name;
  for (const Json& check : checks.is_array() ? checks : Json::array()) {
    const std::optional<double> margin = number_at(check, "margin");
    const std::optional<double> min = number_at(check, "min");
    const std::optional<double> max = number_at(check, "max");
    // An exact value has no margin, and one against zero no scale.
    const bool has_scale = min != max && (min.value_or(0) != 0 || max.value_or(0) != 0);
    if (has_scale && margin && (!worst || *margin < *worst)) {
      worst = margin;
      name = readable_name(text_at(check, "name"), text_at(check, "unit"));
    }
  }
  return worst ? fmt::format("{:.0f}\u00a0% <span class=\"meaning\">{}</span>", 100 * *worst,
                             escaped(name))
               : std::string{};
}

// What is in a fold, from outside: verdict and title.
std::string fold_head(const RunContents& run, const Verdict& verdict) {
  return fmt::format(
      "<summary><span class=\"chip {0}\"><span aria-hidden=\"true\">{1}</span> {2}</span> "
      "<h2>{3}</h2></summary>\n",
      class_of(verdict.kind), symbol_of(verdict.kind), word_of(verdict.kind),
      escaped(run_title(run)));
}

// Open is the one that a reader looks for: the first that did not pass, or else the first.
std::size_t open_fold(std::span<const RunContents> runs) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (verdict_of(runs[i]).kind != VerdictKind::kPass) {
      return i;
    }
  }
  return 0;
}

std::string summary_row(const RunContents& run, std::size_t index) {
  const Verdict verdict = verdict_of(run);
  const std::optional<double> time_s = number_at(run.result, "simulated_time_s");
  const std::optional<double> factor = number_at(run.result, "real_time_factor");
  return fmt::format(
      "<tr class=\"{0}\"><td data-label=\"Verdict\"><span class=\"chip {0}\"><span "
      "aria-hidden=\"true\">{1}</span> {2}</span></td><td data-label=\"Run\" class=\"what\"><a "
      "href=\"#run-{3}\">{4}</a><span class=\"meaning\">{5}</span></td>"
      "<td data-label=\"Worst margin\" class=\"number\">{8}</td>"
      "<td data-label=\"Simulated\" class=\"number\">{6}</td>"
      "<td data-label=\"Speed\" class=\"number\">{7}</td></tr>\n",
      class_of(verdict.kind), symbol_of(verdict.kind), word_of(verdict.kind), index,
      escaped(run_title(run)), escaped(verdict.sentence),
      time_s ? readable_quantity(*time_s, "s") : "unknown",
      factor ? readable_number(*factor) + " ×" : "unknown", worst_margin(run));
}

std::string summary(std::span<const RunContents> runs) {
  std::size_t passed = 0;
  VerdictKind worst = VerdictKind::kPass;
  std::string rows;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const VerdictKind kind = verdict_of(runs[i]).kind;
    passed += kind == VerdictKind::kPass ? 1U : 0U;
    worst = std::max(worst, kind);
    rows += summary_row(runs[i], i + 1);
  }
  return fmt::format(
      "<div class=\"verdict {0}\" data-verdict=\"{1}\">\n<span class=\"sign\" "
      "aria-hidden=\"true\">{2}</span>\n<div><p class=\"word\">{1}</p>\n<p>{3} of {4} runs "
      "passed.</p></div>\n</div>\n<section class=\"runs\"><h2>Runs</h2>\n<table>\n"
      "<thead><tr><th>Verdict</th><th>Run</th><th class=\"number\">Worst "
      "margin</th><th class=\"number\">Simulated</th>"
      "<th class=\"number\">Speed</th></tr></thead>\n<tbody>\n{5}</tbody>\n</table>\n</section>\n",
      class_of(worst), word_of(worst), symbol_of(worst), passed, runs.size(), rows);
}

}  // namespace

std::string run_page(const RunContents& run) {
  Parts parts;
  parts.body =
      "<article class=\"run\" id=\"run-1\">\n<p class=\"eyebrow\">towbench run report</p>\n" +
      heading(1, run_title(run)) + description_of(run);
  append_run(run, 1, 2, kPlotBytes, parts);
  parts.body += "</article>\n";
  return document(run_title(run) + " · towbench", parts);
}

std::string combined_page(std::span<const RunContents> runs) {
  Parts parts;
  parts.body = fmt::format(
      "<header id=\"top\"><p class=\"eyebrow\">towbench run report</p>\n<h1>{} runs on one "
      "page</h1>\n</header>\n",
      runs.size());
  parts.body += summary(runs);
  const std::size_t open = open_fold(runs);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    parts.body +=
        fmt::format("<details class=\"run\" id=\"run-{}\"{}>\n", i + 1, i == open ? " open" : "");
    parts.body += fold_head(runs[i], verdict_of(runs[i])) + description_of(runs[i]);
    append_run(runs[i], i + 1, 3, 2 * kPlotBytes / (runs.size() + 1), parts);
    parts.body += "<p class=\"back\"><a href=\"#top\">Back to the summary</a></p>\n</details>\n";
  }
  return document(fmt::format("{} runs · towbench", runs.size()), parts);
}

}  // namespace towbench::harness::report
