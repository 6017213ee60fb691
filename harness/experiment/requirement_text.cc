#include "harness/experiment/requirement_text.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/fixtures/toml_string.h"
#include "harness/requirements/run_signals.h"

namespace towbench::harness {
namespace {

void check_id(const TableReader& reader, const Requirement& requirement,
              const std::vector<Requirement>& before) {
  const auto& id = requirement.id;
  const bool plain =
      !id.empty() && id.size() <= 60 && std::all_of(id.begin(), id.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '-' || c == '_' || c == '.';
      });
  const bool used = std::any_of(before.begin(), before.end(),
                                [&](const Requirement& other) { return other.id == id; });
  if (!plain || used) {
    throw FixtureError(reader.place_of("id"), '"' + id + '"',
                       "1 to 60 letters, digits, - _ and ., that no other requirement has");
  }
}

}  // namespace

std::vector<Requirement> read_requirements(TableReader& experiment,
                                           const std::vector<EvaluationWindow>& windows) {
  std::vector<std::string> names;
  for (const auto& window : windows) {
    names.push_back(window.name);
  }
  const auto vocabulary = run_vocabulary(std::move(names));
  std::vector<Requirement> requirements;
  for (auto& reader : experiment.tables("requirement")) {
    Requirement requirement;
    reader.text("id", requirement.id, "how checks and falsify call it");
    reader.text("formula", requirement.text, "what must hold");
    reader.text("source", requirement.source, "where it comes from");
    reader.value("under_faults", requirement.under_faults, core::any_finite(),
                 "asked of a machine that was broken too");
    reader.require("id");
    reader.require("formula");
    reader.finish();
    check_id(reader, requirement, requirements);
    auto parsed = parse_formula(requirement.text, vocabulary);
    if (!parsed) {
      throw FixtureError(
          reader.place_of("formula"),
          fmt::format("{} at column {}", parsed.error().given, parsed.error().column),
          parsed.error().allowed);
    }
    requirement.parsed = std::move(*parsed);
    requirements.push_back(std::move(requirement));
  }
  return requirements;
}

std::string to_toml(const Requirement& requirement) {
  auto text = fmt::format("\n[[requirement]]\nid = {}\nformula = {}\n", toml_string(requirement.id),
                          toml_string(requirement.text));
  text += requirement.source.empty() ? "" : "source = " + toml_string(requirement.source) + '\n';
  return text + (requirement.under_faults ? "under_faults = true\n" : "");
}

}  // namespace towbench::harness
