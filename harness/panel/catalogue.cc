#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "bbmc/application/commands/command_table.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/fault_plan/carrier_fit.h"
#include "harness/fault_plan/fault.h"
#include "harness/fault_plan/fault_catalogue.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/panel/own_experiments.h"
#include "harness/panel/panel_json.h"

namespace towbench::harness {
namespace {

using nlohmann::json;

// Infinity has no place in JSON: such an end is left out.
json range_json(const core::Range& range) {
  json ends = json::object();
  if (std::isfinite(range.min)) {
    ends["min"] = range.min;
  }
  if (std::isfinite(range.max)) {
    ends["max"] = range.max;
  }
  return ends;
}

json option_json(const bbmc::OptionSpec& option) {
  constexpr std::array<const char*, 5> kKinds{"flag", "quantity", "whole", "choice", "axis"};
  json object = {{"name", option.name},
                 {"kind", kKinds.at(static_cast<std::size_t>(option.kind))},
                 {"meaning", option.meaning},
                 {"range", range_json(option.range)}};
  if (option.kind == bbmc::OptionKind::kQuantity) {
    object["unit"] = bbmc::display_unit(option.dimension).name;
    object["bare_unit"] = option.bare_unit;
  }
  if (!option.choices.empty()) {
    object["choices"] = option.choices;
  }
  return object;
}

json commands_json() {
  auto commands = json::array();
  for (const auto& command : bbmc::command_table()) {
    json object = {{"word", command.word}, {"sub", command.sub}, {"meaning", command.meaning}};
    for (const auto& option : command.options) {
      if (!option.name.empty()) {
        object["options"].push_back(option_json(option));
      }
    }
    commands.push_back(std::move(object));
  }
  return commands;
}

json faults_json() {
  auto faults = json::array();
  for (const auto& row : fault_catalogue()) {
    json object = {
        {"part", name_of(row.part)},       {"kind", row.name},
        {"meaning", row.meaning},          {"built_in", row.start == FaultStart::kWholeRun},
        {"refused", why_not_by_hand(row)}, {"parameters", json::array()}};
    for (const auto& parameter : row.parameters) {
      if (!parameter.key.empty()) {
        object["parameters"].push_back({{"key", parameter.key},
                                        {"standard", parameter.standard},
                                        {"min", parameter.min},
                                        {"max", parameter.max}});
      }
    }
    faults.push_back(std::move(object));
  }
  return faults;
}

json places_json() {
  auto places = json::array();
  for (const auto& name : all_place_names()) {
    places.push_back({{"name", name}, {"part", name_of(place_named(name)->part)}});
  }
  return places;
}

// Read as `validate` reads it; one that cannot be run says why.
json experiment_json(const std::filesystem::path& path, const std::string& name, bool own,
                     const std::string& controller) {
  try {
    const auto fixture = load_experiment(path);
    const auto& experiment = fixture.experiment;
    json object = {{"name", name.empty() ? experiment.name : name},
                   {"own", own},
                   {"title", experiment.title},
                   {"description", experiment.description},
                   {"duration_limit_s", experiment.duration_limit_s},
                   {"seed", experiment.seed},
                   {"budgets", experiment.budgets.size()},
                   {"lines", json::array()}};
    if (!experiment.reference.empty()) {
      object["controller"] = controller;
      if (controller.empty()) {
        object["trouble"] =
            "no controller follows its [[reference]]: start the panel with "
            "--controller process:COMMAND";
      }
    }
    for (const auto& step : experiment.console) {
      object["lines"].push_back(step.send);
    }
    return object;
  } catch (const FixtureError& error) {
    return {{"name", name.empty() ? path.stem().string() : name},
            {"own", own},
            {"trouble", error.what()}};
  }
}

json experiments_json(const std::string& controller) {
  auto experiments = json::array();
  for (const auto& path : own_experiments(".")) {
    experiments.push_back(experiment_json(path, path.string(), true, controller));
  }
  if (!controller.empty()) {
    for (const auto& [name, path] : any_controller_experiments()) {
      experiments.push_back(experiment_json(path, name, false, controller));
    }
  }
  for (const auto& path : toml_files_in(fixtures_directory() / "experiments")) {
    experiments.push_back(experiment_json(path, "", false, controller));
  }
  return experiments;
}

}  // namespace

std::string catalogue_json(const std::string& controller) {
  return json{{"experiments", experiments_json(controller)},
              {"faults", faults_json()},
              {"places", places_json()},
              {"commands", commands_json()}}
      .dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace towbench::harness
