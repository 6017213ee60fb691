#include <fmt/format.h>

#include "harness/report/html.h"
#include "harness/report/quantity.h"
#include "harness/report/sections.h"

namespace towbench::harness::report {
namespace {

using Json = nlohmann::json;

std::string scalar_text(const Json& value) {
  if (value.is_null()) {
    return {};
  }
  if (value.is_string()) {
    return value.get<std::string>();
  }
  return value.is_number_float() ? readable_number(value.get<double>())
                                 : value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string entry(std::string_view term, const std::string& text, bool code = false) {
  if (text.empty()) {
    return {};
  }
  const std::string shown = escaped(text);
  return fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(term),
                     code ? "<code>" + shown + "</code>" : shown);
}

// An object as one entry a member, or a list joined; whatever the writer put there is shown.
std::string entries(std::string_view term, const Json& value, bool code) {
  if (!value.is_object()) {
    return entry(term, scalar_text(value), code);
  }
  std::string html;
  for (const auto& [key, inner] : value.items()) {
    html += entry(fmt::format("{}: {}", term, key), scalar_text(inner), code);
  }
  return html;
}

}  // namespace

std::string provenance_section(const RunContents& run, int level) {
  std::string html =
      "<section class=\"provenance\">\n" + heading(level, "Where these numbers come from");
  const Json& result = run.result;
  if (!result.is_object()) {
    return html + missing_note("Unknown: there is no readable result.json.") + "</section>\n";
  }
  const Json& experiment = member(result, "experiment");
  html += "<dl class=\"provenance\">\n";
  html += entry("Run folder", run.folder_name, true);
  html += entry("Replay with", "./towbench replay runs/" + run.folder_name, true);
  html += entry("Experiment", text_at(experiment, "name"));
  html += entry("Experiment file", text_at(experiment, "file"), true);
  html += entry("Origin", std::string(sentence_for(run.origin)));
  html += entry("Started", text_at(result, "started_utc"));
  for (const char* key : {"clock", "carrier", "fidelity", "seed", "control_rate_Hz"}) {
    std::string term = key;
    term[0] = static_cast<char>(term[0] - 'a' + 'A');
    html += entry(term, scalar_text(member(result, key)));
  }
  html += entries("Version", member(result, "version"), false);
  html += entries("Fixture hash", member(result, "hashes"), true);
  if (result.contains("image")) {
    html += entries("Image", member(result, "image"), true);
  }
  html += entries("Machine", member(result, "machine"), false);
  html += entries("Rows", member(result, "rows"), false);
  return html + "</dl>\n</section>\n";
}

}  // namespace towbench::harness::report
