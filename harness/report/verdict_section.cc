#include <algorithm>

#include <fmt/format.h>

#include "harness/report/html.h"
#include "harness/report/quantity.h"
#include "harness/report/sections.h"

namespace towbench::harness::report {
namespace {

std::string fact(std::string_view term, const std::string& value) {
  return value.empty()
             ? std::string{}
             : fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(term), escaped(value));
}

std::string quantity_at(const nlohmann::json& object, std::string_view key, std::string_view unit) {
  const std::optional<double> value = number_at(object, key);
  return value ? readable_quantity(*value, unit) : std::string{};
}

std::string list_of(const std::vector<std::string>& sentences) {
  constexpr std::size_t kMost = 30;
  std::string items;
  for (std::size_t i = 0; i < std::min(sentences.size(), kMost); ++i) {
    items += fmt::format("<li>{}</li>\n", escaped(sentences[i]));
  }
  if (sentences.size() > kMost) {
    items += fmt::format("<li>and {} more</li>\n", sentences.size() - kMost);
  }
  return items.empty() ? items : "<ul class=\"remarks\">\n" + items + "</ul>\n";
}

}  // namespace

std::string run_title(const RunContents& run) {
  const nlohmann::json& experiment = member(run.result, "experiment");
  for (const char* key : {"title", "name"}) {
    if (std::string text = text_at(experiment, key); !text.empty()) {
      return text;
    }
  }
  return run.folder_name;
}

std::string verdict_section(const RunContents& run, const Verdict& verdict) {
  std::string html = fmt::format(
      "<div class=\"verdict {}\" data-verdict=\"{}\">\n"
      "<span class=\"sign\" aria-hidden=\"true\">{}</span>\n"
      "<div><p class=\"word\">{}</p>\n<p>{}</p></div>\n</div>\n",
      class_of(verdict.kind), word_of(verdict.kind), symbol_of(verdict.kind), word_of(verdict.kind),
      escaped(verdict.sentence));
  html += list_of(run.contradictions) + list_of(run.remarks);
  const nlohmann::json& result = run.result;
  const std::optional<double> factor = number_at(result, "real_time_factor");
  html += "<dl class=\"facts\">\n";
  html += fact("Simulated time", quantity_at(result, "simulated_time_s", "s"));
  html += fact("Wall time", quantity_at(result, "wall_time_s", "s"));
  html += fact("Speed", factor ? readable_number(*factor) + " × real time" : "");
  html += fact("Clock", text_at(result, "clock"));
  html += fact("Carrier", text_at(result, "carrier"));
  html += fact("Fidelity", text_at(result, "fidelity"));
  html += fact("Seed", quantity_at(result, "seed", ""));
  return html + "</dl>\n";
}

}  // namespace towbench::harness::report
