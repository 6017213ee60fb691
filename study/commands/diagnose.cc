// towbench diagnose: what a model gets wrong, from measured data (docs/theory/diagnosis.md).
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "core/axis.h"
#include "harness/checks/check.h"
#include "harness/commands/option_checks.h"
#include "harness/fixtures/nearest_key.h"
#include "study/commands/diagnose_active.h"
#include "study/commands/diagnose_logs.h"
#include "study/commands/verbs.h"
#include "study/diagnose/cause_list.h"
#include "study/diagnose/diagnosis_json.h"
#include "study/diagnose/explain.h"
#include "study/diagnose/headline.h"

namespace towbench::study {
namespace {

int diagnose_once(const DiagnoseOptions& options) {
  if (has_no_model(options) && options.columns.empty()) {
    std::fputs(explained_columns(options).c_str(), stdout);
    throw UnusableData(options.data.front() +
                       ": neither map nor model: save the map above as map.toml, correct it, and "
                       "give --columns map.toml");
  }
  const PlantModel plant = plant_of(options);
  const diagnose::Diagnosis d = diagnose_logs(options, plant);
  write_diagnosis(options, plant, d);
  if (options.json) {
    std::fputs(diagnose::diagnosis_json(d).c_str(), stdout);
  } else {
    std::fputs(diagnose::headline(d).c_str(), stdout);
    for (const auto& effect : options.explain) {
      std::fputs(diagnose::explain(d, effect).c_str(), stdout);
    }
    std::printf("%s\n", (std::filesystem::path(options.out) / "report.html").c_str());
  }
  return harness::kExitPass;
}

std::vector<std::string> names_that_can_be_explained() {
  std::vector<std::string> names(diagnose::kParameterNames.begin(),
                                 diagnose::kParameterNames.end());
  for (const diagnose::Effect& effect : diagnose::effects()) names.push_back(effect.name);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

// Empty where it is one.
std::string refused_as_a_cause(const std::string& name) {
  const std::vector<std::string> known = names_that_can_be_explained();
  if (std::find(known.begin(), known.end(), name) != known.end()) return {};
  const std::string meant = harness::nearest_key(name, known);
  return "no cause '" + name + "'; " +
         (meant.empty() ? std::string() : "did you mean " + meant + "? ") + "--causes lists them";
}

int execute_diagnose(const DiagnoseOptions& options, const ActiveOptions& active) {
  try {
    return active.wanted ? diagnose_and_run(options, active) : diagnose_once(options);
  } catch (const UnusableData& error) {
    std::fprintf(stderr, "towbench: diagnose: %s\n", error.what());
    return harness::kExitBadInput;
  }
}

}  // namespace

void add_diagnose(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<DiagnoseOptions>();
  auto active = std::make_shared<ActiveOptions>();
  auto* verb = app.add_subcommand("diagnose", "name what a model gets wrong, from measured data");
  verb->add_option("--model", options->model,
                   "plant file; default: that of the first run folder, else none")
      ->check(CLI::ExistingFile);
  verb->add_option("--data", options->data,
                   "run folder of the bench, or a log (CSV, MAT, MCAP); once for each run")
      ->required()
      ->check(CLI::ExistingPath);
  verb->add_option("--holdout", options->holdout, "the same, to judge on; never fitted")
      ->check(CLI::ExistingPath);
  verb->add_option("--columns", options->columns, "TOML map of a foreign log's columns")
      ->check(CLI::ExistingFile);
  verb->add_option("--axis", options->axis, "axis of the plant")
      ->check(CLI::IsMember(
          std::vector<std::string>(core::kAxisNames.begin(), core::kAxisNames.end())));
  verb->add_option("--explain", options->explain,
                   "why this effect was named, or not; may be repeated")
      ->check(CLI::Validator(refused_as_a_cause, ""));
  verb->add_flag_callback(
      "--causes",
      [] {
        std::fputs(diagnose::cause_list().c_str(), stdout);
        throw CLI::Success();
      },
      "print what can be named, with laws and sources, and exit");
  verb->add_option("--out", options->out, "folder to write to")->check(harness::folder_to_write());
  verb->add_option("--seed", options->seed, "of the bootstrap and the simulated references")
      ->check(harness::whole_number());
  verb->add_flag("-q,--quiet", options->quiet, "no progress");
  verb->add_flag("--json", options->json, "print diagnosis.json");
  add_active_options(*verb, *active);
  verb->footer(
      "Example: towbench diagnose --data runs/FOLDER --out found\n"
      "         towbench diagnose --active --rig hidden.toml --model plant.toml --data "
      "runs/FOLDER\n"
      "         towbench diagnose --model plant.toml --data a.csv --data b.csv --columns map.toml\n"
      "         towbench diagnose --data log.csv\n"
      "         towbench diagnose --data runs/FOLDER --explain backlash\n"
      "         towbench diagnose --causes\n"
      "A log alone is explained, with a map to correct; with its map and no model, mass and "
      "friction "
      "are estimated.\n"
      "Writes report.html, headline.txt, diagnosis.json, extended_plant.toml, residual.csv.\n"
      "Exit: 0 diagnosed, 2 the data cannot be diagnosed (one line says why).");
  verb->callback(
      [options, active, &exit_code] { exit_code = execute_diagnose(*options, *active); });
}

}  // namespace towbench::study
