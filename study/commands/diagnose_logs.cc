#include "study/commands/diagnose_logs.h"

#include <algorithm>

#include "harness/commands/progress_line.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/proof/run_manifest.h"
#include "harness/record/line_writer.h"
#include "study/commands/leave_on_signal.h"
#include "study/diagnose/bench_columns.h"
#include "study/diagnose/diagnosis_json.h"
#include "study/diagnose/headline.h"
#include "study/diagnose/proposed_map.h"
#include "study/diagnose/run_reader.h"
#include "study/diagnosis_page/page.h"
#include "study/extended_plant/emulated_log.h"
#include "study/extended_plant/estimated_plant.h"
#include "study/extended_plant/extended_plant.h"
#include "study/logs/column_map.h"
#include "study/logs/read_table.h"

namespace towbench::study {
namespace {

// What the plant did is not opened, not even for its hash.
void refuse_changed(const std::filesystem::path& folder) {
  const auto manifest = harness::check_manifest(folder, [](const std::string& name) {
    return name == "log.csv" || name == "result.json" || name.starts_with("inputs/");
  });
  if (!manifest.present && std::filesystem::exists(folder / "result.json")) {
    throw UnusableData(folder.string() +
                       ": manifest.json is missing: the record cannot be checked");
  }
  if (!manifest.problems.empty()) {
    throw UnusableData(folder.string() + ": " + manifest.problems.front());
  }
}

// A run folder of the bench stands for the log in it.
std::filesystem::path log_of(const std::filesystem::path& given) {
  if (!std::filesystem::is_directory(given)) {
    return given;
  }
  refuse_changed(given);
  return given / "log.csv";
}

void refuse_fatal(const logs::Findings& findings) {
  for (const auto& finding : findings) {
    if (finding.kind == logs::Finding::Kind::kFatal) {
      throw UnusableData(finding.name + ": " + finding.sentence);
    }
  }
}

std::vector<diagnose::Run> read_logs(const std::vector<std::string>& paths,
                                     const DiagnoseOptions& options, diagnose::NominalModel& model,
                                     logs::Findings& findings) {
  std::vector<diagnose::Run> runs;
  runs.reserve(paths.size());
  for (const auto& path : paths) {
    runs.push_back(read_log(path, options, model, findings));
  }
  return runs;
}

toml::table plant_before(const DiagnoseOptions& options, const PlantModel& plant,
                         const diagnose::Diagnosis& d) {
  return has_no_model(options) ? diagnose::estimated_plant(d) : plant.plant;
}

// The logs that judge: the held-out ones, or what was fitted, without runs and stretches that are
// left out.
std::vector<diagnose::Run> judging_runs(const diagnose::Request& request,
                                        const diagnose::Diagnosis& d) {
  if (!request.holdout.empty()) return request.holdout;
  std::vector<diagnose::Run> all = request.runs;
  diagnose::leave_out(d.stretches, all);
  std::vector<diagnose::Run> runs;
  for (std::size_t run = 0; run < all.size(); ++run) {
    const bool left_out = std::find(d.left_out.begin(), d.left_out.end(), run) != d.left_out.end();
    if (!left_out) runs.push_back(std::move(all[run]));
  }
  return runs;
}

// The emulator on the logs that judge. None, and a note, of a machine beyond what it can step.
void emulate(const DiagnoseOptions& options, const PlantModel& plant,
             const diagnose::Request& request, diagnose::Diagnosis& d) {
  const toml::table before = plant_before(options, plant, d);
  try {
    const diagnose::ExtendedPlant extended = diagnose::extend_plant(before, d);
    d.emulated = diagnose::emulate(judging_runs(request, d), d.context.stated, before,
                                   toml::parse(extended.text));
    d.emulated->left_out = extended.left_out;
  } catch (const harness::FixtureError& error) {
    d.findings.push_back({logs::Finding::Kind::kNote, "plant_refused", error.what()});
  }
}

}  // namespace

bool has_no_model(const DiagnoseOptions& options) {
  return options.model.empty() && !std::filesystem::is_directory(options.data.front());
}

std::string explained_columns(const DiagnoseOptions& options) {
  logs::Findings findings;
  const auto table = logs::read_table(options.data.front(), findings);
  refuse_fatal(findings);
  std::string notes;
  for (const auto& finding : findings) {
    notes += "Note:          " + finding.sentence + "\n";
  }
  return notes + diagnose::explain_columns(table, options.data.front());
}

PlantModel plant_of(const DiagnoseOptions& options) {
  if (!has_no_model(options)) {
    return load_plant_model(model_of(options), options.axis);
  }
  PlantModel none;
  none.model.axis = options.axis;
  none.model.supplied = false;
  return none;
}

std::filesystem::path model_of(const DiagnoseOptions& options) {
  if (!options.model.empty()) {
    return options.model;
  }
  const std::filesystem::path first = options.data.front();
  const auto plants = std::filesystem::is_directory(first / "inputs" / "plants")
                          ? harness::toml_files_in(first / "inputs" / "plants")
                          : std::vector<std::filesystem::path>{};
  if (plants.size() != 1) {
    throw UnusableData("no --model, and " + first.string() +
                       " is no run folder with the one plant it was run with");
  }
  return plants.front();
}

diagnose::Run read_log(const std::string& path, const DiagnoseOptions& options,
                       diagnose::NominalModel& model, logs::Findings& findings) {
  const auto log = log_of(path);
  const auto table = logs::read_table(log, findings);
  refuse_fatal(findings);
  auto map = options.columns.empty() ? diagnose::bench_columns(table, model, log.string(), findings)
                                     : logs::read_column_map(options.columns, findings);
  diagnose::use_model_units(map, model, options.columns, findings);
  refuse_fatal(findings);
  model.input_is_held = map.input_hold.value_or(model.input_is_held);
  model.rotary = model.rotary || map.rotary;
  diagnose::Run run = diagnose::make_run(table, map, log.string(), findings);
  refuse_fatal(findings);
  return run;
}

diagnose::Diagnosis diagnose_logs(const DiagnoseOptions& options, PlantModel plant) {
  const LeaveOnSignal until_it_writes;
  logs::Findings findings;
  diagnose::Request request;
  request.runs = read_logs(options.data, options, plant.model, findings);
  request.holdout = read_logs(options.holdout, options, plant.model, findings);
  request.model = plant.model;
  harness::ProgressLine progress(!options.quiet);
  request.progress = [&progress](const std::string& line) { progress.show(line); };
  diagnose::Diagnosis d = diagnose::diagnose(request);
  if (!is_fatal(d.findings)) {
    progress.show("the emulator on the logs");
    emulate(options, plant, request, d);
  }
  d.findings.insert(d.findings.begin(), findings.begin(), findings.end());
  return d;
}

void write_diagnosis(const DiagnoseOptions& options, const PlantModel& plant,
                     const diagnose::Diagnosis& d) {
  refuse_fatal(d.findings);
  const std::filesystem::path folder = options.out;
  std::filesystem::create_directories(folder);
  harness::write_atomically(folder / "diagnosis.json", diagnose::diagnosis_json(d));
  const bool none = has_no_model(options);
  const auto extended = folder / "extended_plant.toml";
  if (d.emulated) {
    harness::write_atomically(extended,
                              diagnose::extend_plant(plant_before(options, plant, d), d).text);
  } else {
    std::filesystem::remove(extended);  // an earlier diagnosis wrote it
  }
  diagnose::write_series(d, folder);
  harness::write_atomically(
      folder / "report.html",
      diagnosis_page::page((none ? "Diagnosis of " + options.data.front()
                                 : "Diagnosis of " + model_of(options).filename().string()) +
                               ", axis " + options.axis,
                           d));
  harness::write_atomically(folder / "headline.txt", diagnose::headline(d));
}

}  // namespace towbench::study
