#include "study/runs/kept_runs.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "harness/checks/check.h"
#include "harness/experiment/experiment_toml.h"
#include "harness/fixtures/canonical_hash.h"
#include "harness/fixtures/toml_string.h"
#include "harness/fixtures/toml_text.h"
#include "harness/record/line_writer.h"
#include "harness/record/temporary_folder.h"
#include "study/runs/run_columns.h"

namespace towbench::study {
namespace {

constexpr const char* kRigFile = "rig.toml";
constexpr const char* kPlantFile = "plant.toml";
constexpr const char* kControllerFile = "controller.toml";
constexpr const char* kExperimentFile = "experiment.toml";

// What an experiment may be called: a-z, 0-9 and -.
std::string plain_name(const std::string& words) {
  constexpr std::size_t kLongest = 60;
  std::string name;
  for (const char c : words) {
    const auto byte = static_cast<unsigned char>(c);
    const bool kept = std::isalnum(byte) != 0 && byte < 0x80;
    if (kept) {
      name += static_cast<char>(std::tolower(byte));
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  name.resize(std::min(name.size(), kLongest));
  return !name.empty() && name.back() == '-' ? name.substr(0, name.size() - 1) : name;
}

// The first thing that went wrong, in words.
std::string trouble_of(const harness::RunResult& result) {
  if (!result.complete) {
    return result.reason;
  }
  for (const auto& check : result.judgement.checks) {
    if (check.verdict != harness::Verdict::kPass) {
      return check.reason.empty() ? check.name : check.reason;
    }
  }
  return result.exit_code == harness::kExitPass ? "" : "the run's report contradicts its record";
}

}  // namespace

void write_machine(const harness::RigFixture& rig, const harness::ControllerFixture& controller,
                   const std::filesystem::path& folder) {
  harness::write_atomically(folder / kPlantFile, harness::plant_toml(rig));
  harness::write_atomically(folder / kRigFile,
                            fmt::format("schema = 1\nname = {}\nplants = [\"{}\"]\n",
                                        harness::toml_string(rig.name), kPlantFile));
  harness::write_atomically(folder / kControllerFile, harness::controller_toml(controller));
}

harness::ExperimentFixture as_experiment(const procedures::PlannedRun& planned,
                                         const std::string& id,
                                         const std::filesystem::path& folder) {
  write_machine(planned.rig, planned.controller, folder);
  harness::ExperimentFixture fixture;
  fixture.experiment = planned.experiment;
  fixture.experiment.name = plain_name(planned.experiment.name);
  fixture.experiment.title = fmt::format("{}: {}", id, planned.experiment.name);
  fixture.experiment.description =
      fmt::format("A run of `towbench tow --only {}`: machine {}, controller {}.", id,
                  planned.rig.name, planned.controller.name);
  fixture.experiment.windows.resize(1);
  fixture.experiment.budgets = {{.metric = "fault_number", .max = 0.0, .source = "TOW-10"}};
  fixture.rig = planned.rig;
  harness::write_atomically(folder / kExperimentFile,
                            harness::to_toml(fixture, kRigFile, kControllerFile));
  auto read = harness::load_experiment(folder / kExperimentFile);
  const auto same = [&](const char* file, std::uint64_t given, std::uint64_t wanted) {
    if (given != wanted) {
      throw harness::FixtureError({(folder / file).string()}, "other values than were planned",
                                  "a file that reads back as what was written");
    }
  };
  same(kRigFile, read.rig.hash, harness::canonical_hash(planned.rig.parameters));
  same(kControllerFile, read.controller.hash,
       harness::canonical_hash(planned.controller.configuration));
  return read;
}

identify::Recording KeptRuns::run(const procedures::PlannedRun& planned) {
  const harness::TemporaryFolder files;
  const auto fixture = as_experiment(planned, id_, files.path());
  const auto result = play_(fixture, out_ / id_, planned.seed);
  made_.push_back({.experiment = id_,
                   .name = planned.experiment.name,
                   .folder = (std::filesystem::path(id_) / result.folder.filename()).string()});
  auto recording = result.complete ? read_run_columns(result.folder) : identify::Recording{};
  if (recording.trouble.empty()) {
    recording.trouble = trouble_of(result);
  }
  return recording;
}

}  // namespace towbench::study
