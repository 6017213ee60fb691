// towbench diagnose: what a model gets wrong, from measured data (docs/diagnosis.md).
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "harness/commands/command.h"
#include "harness/commands/plant_model.h"
#include "harness/diagnose/column_map.h"
#include "harness/diagnose/diagnosis_json.h"
#include "harness/diagnose/extended_plant.h"
#include "harness/diagnose/headline.h"
#include "harness/diagnose/run_reader.h"
#include "harness/judge/check.h"

namespace towbench::harness {
namespace {

struct DiagnoseOptions {
  std::string model;
  std::vector<std::string> data;
  std::vector<std::string> holdout;
  std::string columns;
  std::string axis = "y";
  std::string out = "diagnosis";
  std::uint64_t seed = 1;
  bool quiet = false;
  bool json = false;
};

std::vector<diagnose::Run> read_runs(const std::vector<std::string>& paths,
                                     const DiagnoseOptions& options, diagnose::NominalModel& model,
                                     diagnose::Findings& findings) {
  std::vector<diagnose::Run> runs;
  for (const auto& path : paths) {
    const auto table = diagnose::read_table(path, findings);
    if (diagnose::is_fatal(findings)) {
      break;
    }
    const auto map = options.columns.empty() ? diagnose::bench_columns(table, model, findings)
                                             : diagnose::read_column_map(options.columns, findings);
    if (diagnose::is_fatal(findings)) {
      break;
    }
    model.input_is_held = map.input_hold.value_or(model.input_is_held);
    runs.push_back(diagnose::make_run(table, map, path, findings));
  }
  return runs;
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  if (!file.flush()) {
    throw std::runtime_error(path.string() + ": cannot be written");
  }
}

int execute(const DiagnoseOptions& options) {
  PlantModel plant = load_plant_model(options.model, options.axis);
  diagnose::Findings findings;
  diagnose::Request request;
  request.runs = read_runs(options.data, options, plant.model, findings);
  request.holdout = read_runs(options.holdout, options, plant.model, findings);
  request.model = plant.model;
  request.seed = options.seed;
  const bool told = !options.quiet && isatty(STDERR_FILENO) != 0;
  request.progress = [told](const std::string& line) {
    if (told) {
      std::fprintf(stderr, "%s\n", line.c_str());
    }
  };
  diagnose::Diagnosis d;
  const bool usable = !diagnose::is_fatal(findings);
  if (usable) {
    d = diagnose::diagnose(request);
  }
  d.findings.insert(d.findings.begin(), findings.begin(), findings.end());
  const std::filesystem::path folder = options.out;
  std::filesystem::create_directories(folder);
  const std::string json = diagnose::diagnosis_json(d);
  write_text(folder / "diagnosis.json", json);
  std::fputs(options.json ? json.c_str() : diagnose::headline(d).c_str(), stdout);
  if (diagnose::is_fatal(d.findings)) {
    return usable ? kExitInvalid : kExitBadInput;
  }
  write_text(folder / "extended_plant.toml", diagnose::extend_plant(plant.plant, d).text);
  diagnose::write_series(d, folder);
  if (!options.json) {
    std::printf("%s\n", (folder / "diagnosis.json").c_str());
  }
  return kExitPass;
}

}  // namespace

void add_diagnose(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<DiagnoseOptions>();
  auto* verb = app.add_subcommand("diagnose", "name what a model gets wrong, from measured data");
  verb->add_option("--model", options->model, "plant file")->required()->check(CLI::ExistingFile);
  verb->add_option("--data", options->data, "CSV log; give it once for each run")->required();
  verb->add_option("--holdout", options->holdout, "CSV log to judge on; never fitted");
  verb->add_option("--columns", options->columns, "TOML map of a foreign log's columns")
      ->check(CLI::ExistingFile);
  verb->add_option("--axis", options->axis, "axis of the plant")->check(CLI::IsMember({"y", "x"}));
  verb->add_option("--out", options->out, "folder to write to");
  verb->add_option("--seed", options->seed, "of the bootstrap and the twins");
  verb->add_flag("--quiet", options->quiet, "no progress");
  verb->add_flag("--json", options->json, "print diagnosis.json");
  verb->footer(
      "Example: towbench diagnose --model plant.toml --data run1.csv --data run2.csv --out found\n"
      "Writes diagnosis.json, extended_plant.toml, residual.csv. Exit: 0 diagnosed, 2 the data\n"
      "cannot be read, 4 the data and the model do not belong together.");
  verb->callback([options, &exit_code] { exit_code = execute(*options); });
}

}  // namespace towbench::harness
