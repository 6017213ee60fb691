// towbench diagnose: what a model gets wrong, from measured data (docs/diagnosis.md).
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <unistd.h>

#include "harness/commands/command.h"
#include "harness/commands/fixture_paths.h"
#include "harness/commands/plant_model.h"
#include "harness/diagnose/column_map.h"
#include "harness/diagnose/diagnosis_json.h"
#include "harness/diagnose/extended_plant.h"
#include "harness/diagnose/headline.h"
#include "harness/diagnose/run_reader.h"
#include "harness/diagnosis_page/page.h"
#include "harness/judge/check.h"

namespace towbench::harness {
namespace {

// What was given cannot be diagnosed: one line, exit code 2.
class UnusableData : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

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

// A run folder of the bench stands for the log in it.
std::filesystem::path log_of(const std::filesystem::path& given) {
  return std::filesystem::is_directory(given) ? given / "log.csv" : given;
}

// The model that was asked for, or the plant that the first run folder says it was run with.
std::filesystem::path model_of(const DiagnoseOptions& options) {
  if (!options.model.empty()) {
    return options.model;
  }
  const std::filesystem::path first = options.data.front();
  const auto plants = std::filesystem::is_directory(first / "inputs" / "plants")
                          ? toml_files_in(first / "inputs" / "plants")
                          : std::vector<std::filesystem::path>{};
  if (plants.size() != 1) {
    throw UnusableData("no --model, and " + first.string() +
                       " is no run folder with the one plant it was run with");
  }
  return plants.front();
}

void refuse_fatal(const diagnose::Findings& findings) {
  for (const auto& finding : findings) {
    if (finding.kind == diagnose::Finding::Kind::kFatal) {
      throw UnusableData(finding.name + ": " + finding.sentence);
    }
  }
}

std::vector<diagnose::Run> read_runs(const std::vector<std::string>& paths,
                                     const DiagnoseOptions& options, diagnose::NominalModel& model,
                                     diagnose::Findings& findings) {
  std::vector<diagnose::Run> runs;
  for (const auto& path : paths) {
    const auto log = log_of(path);
    const auto table = diagnose::read_table(log, findings);
    refuse_fatal(findings);
    const auto map = options.columns.empty() ? diagnose::bench_columns(table, model, findings)
                                             : diagnose::read_column_map(options.columns, findings);
    refuse_fatal(findings);
    model.input_is_held = map.input_hold.value_or(model.input_is_held);
    runs.push_back(diagnose::make_run(table, map, log.string(), findings));
    refuse_fatal(findings);
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

diagnose::Diagnosis diagnosed(const DiagnoseOptions& options, PlantModel& plant) {
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
  diagnose::Diagnosis d = diagnose::diagnose(request);
  d.findings.insert(d.findings.begin(), findings.begin(), findings.end());
  return d;
}

void write_results(const DiagnoseOptions& options, const std::filesystem::path& model,
                   const PlantModel& plant, const diagnose::Diagnosis& d) {
  const std::filesystem::path folder = options.out;
  std::filesystem::create_directories(folder);
  const std::string json = diagnose::diagnosis_json(d);
  write_text(folder / "diagnosis.json", json);
  refuse_fatal(d.findings);
  write_text(folder / "extended_plant.toml", diagnose::extend_plant(plant.plant, d).text);
  diagnose::write_series(d, folder);
  write_text(folder / "report.html",
             diagnosis_page::page("Diagnosis of " + model.string() + ", axis " + options.axis, d));
  const std::string headline = diagnose::headline(d);
  write_text(folder / "headline.txt", headline);
  std::fputs(options.json ? json.c_str() : headline.c_str(), stdout);
  if (!options.json) {
    std::printf("%s\n", (folder / "report.html").c_str());
  }
}

int execute(const DiagnoseOptions& options) {
  try {
    const auto model = model_of(options);
    PlantModel plant = load_plant_model(model, options.axis);
    const diagnose::Diagnosis d = diagnosed(options, plant);
    write_results(options, model, plant, d);
    return kExitPass;
  } catch (const UnusableData& error) {
    std::fprintf(stderr, "towbench: diagnose: %s\n", error.what());
    return kExitBadInput;
  }
}

}  // namespace

void add_diagnose(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<DiagnoseOptions>();
  auto* verb = app.add_subcommand("diagnose", "name what a model gets wrong, from measured data");
  verb->add_option("--model", options->model, "plant file; default: that of the first run folder")
      ->check(CLI::ExistingFile);
  verb->add_option("--data", options->data,
                   "run folder of the bench, or CSV log; once for each run")
      ->required()
      ->check(CLI::ExistingPath);
  verb->add_option("--holdout", options->holdout, "the same, to judge on; never fitted")
      ->check(CLI::ExistingPath);
  verb->add_option("--columns", options->columns, "TOML map of a foreign log's columns")
      ->check(CLI::ExistingFile);
  verb->add_option("--axis", options->axis, "axis of the plant")->check(CLI::IsMember({"y", "x"}));
  verb->add_option("--out", options->out, "folder to write to");
  verb->add_option("--seed", options->seed, "of the bootstrap and the twins");
  verb->add_flag("-q,--quiet", options->quiet, "no progress");
  verb->add_flag("--json", options->json, "print diagnosis.json");
  verb->footer(
      "Example: towbench diagnose --data runs/FOLDER --out found\n"
      "         towbench diagnose --model plant.toml --data a.csv --data b.csv --columns map.toml\n"
      "Writes report.html, headline.txt, diagnosis.json, extended_plant.toml, residual.csv.\n"
      "Exit: 0 diagnosed, 2 the data cannot be diagnosed (one line says why).");
  verb->callback([options, &exit_code] { exit_code = execute(*options); });
}

}  // namespace towbench::harness
