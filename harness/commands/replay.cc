// towbench replay: runs a folder's inputs again and compares the records byte for byte.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "harness/checks/sensor_files.h"
#include "harness/commands/command.h"
#include "harness/commands/exit_codes.h"
#include "harness/commands/experiment_options.h"
#include "harness/commands/option_checks.h"
#include "harness/commands/stop_signal.h"
#include "harness/fault_cases/shrink.h"
#include "harness/files/regular_file.h"
#include "harness/proof/run_manifest.h"
#include "harness/record/temporary_folder.h"
#include "harness/run/experiment_run.h"
#include "harness/run/wall_clock_replay.h"

namespace towbench::harness {
namespace {

struct ReplayOptions {
  std::string folder;
  std::string out;
  std::string carrier = "in-process";
  bool shrink = false;
};

struct Recorded {
  std::filesystem::path experiment;
  std::uint64_t seed = 0;
  bool by_wall_clock = false;
  std::string carrier;
  std::filesystem::path image;  // of the virtual board, in the folder
  bool typed_by_hand = false;   // at the image's console
};

nlohmann::json result_in(const std::filesystem::path& folder) {
  constexpr std::uint64_t kLargestResult_bytes = 64U << 20U;
  const auto file = folder / "result.json";
  const auto text = read_regular_file(file, kLargestResult_bytes);
  if (const auto* refused = std::get_if<Unreadable>(&text)) {
    throw FixtureError({file.string()}, refused->what, "a run folder");
  }
  return nlohmann::json::parse(std::get<std::string>(text), nullptr, false);
}

Recorded recorded_in(const std::filesystem::path& folder) {
  const auto result = result_in(folder);
  try {
    if (result.at("status") != "complete") {
      throw FixtureError({(folder / "result.json").string(), 0, "status"},
                         result.at("status").dump(),
                         "\"complete\": a run that was cut short has no whole record to compare");
    }
    const auto image = result.value("image", nlohmann::json::object()).value("file", "");
    const auto checks = result.value("checks", nlohmann::json::array());
    const bool by_hand = std::any_of(checks.begin(), checks.end(), [](const auto& check) {
      return check.value("name", "") == "driven_by_hand";
    });
    return {folder / result.at("experiment").at("file").get<std::string>(),
            result.at("seed").get<std::uint64_t>(),
            result.at("clock") == "real",
            result.at("carrier").get<std::string>(),
            image.empty() ? "" : folder / image,
            by_hand && !image.empty()};
  } catch (const nlohmann::json::exception& error) {
    throw FixtureError({(folder / "result.json").string()}, error.what(), "a run's result.json");
  }
}

// "" when equal, else a sentence about the first line that is not.
std::string first_difference(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::ifstream first(a, std::ios::binary);
  std::ifstream second(b, std::ios::binary);
  if (!first || !second) {
    return fmt::format("{} cannot be read", (first ? b : a).string());
  }
  std::string line_a;
  std::string line_b;
  for (std::size_t line = 1;; ++line) {
    const bool more_a = static_cast<bool>(std::getline(first, line_a));
    const bool more_b = static_cast<bool>(std::getline(second, line_b));
    if (!more_a && !more_b) {
      return {};
    }
    if (more_a != more_b || line_a != line_b || first.eof() != second.eof()) {
      return fmt::format("{} differs at line {}:\n  recorded: {}\n  replayed: {}",
                         a.filename().string(), line, more_a ? line_a : "(end)",
                         more_b ? line_b : "(end)");
    }
  }
}

std::filesystem::path make_temporary_folder() {
  auto pattern = (std::filesystem::temp_directory_path() / "towbench-replay-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw std::filesystem::filesystem_error("cannot create", pattern,
                                            std::error_code(errno, std::generic_category()));
  }
  return pattern;
}

int compare(const std::filesystem::path& recorded, const RunResult& run) {
  if (!run.complete) {
    std::fprintf(stderr, "towbench: the replay did not finish: %s\n", run.reason.c_str());
    return kExitRuntime;
  }
  int exit_code = kExitPass;
  std::vector<std::string> files{"log.csv", "truth.csv", "events.jsonl"};
  for (const auto& sensor : sensor_files()) {
    if (std::filesystem::exists(recorded / sensor) ||
        std::filesystem::exists(run.folder / sensor)) {
      files.push_back(sensor);
    }
  }
  for (const auto& file : files) {
    if (const auto difference = first_difference(recorded / file, run.folder / file);
        !difference.empty()) {
      std::printf("%s\n", difference.c_str());
      exit_code = kExitFail;
    } else {
      std::printf("%-13s identical\n", file.c_str());
    }
  }
  return exit_code;
}

// What was claimed of the run against what is judged of it now, from the inputs in the folder.
int compare_verdicts(const std::filesystem::path& recorded, const RunResult& run) {
  if (!run.complete) {
    return kExitRuntime;
  }
  const auto claimed = result_in(recorded);
  const auto judged = result_in(run.folder);
  for (const char* member : {"verdict", "checks", "hashes"}) {
    if (claimed.value(member, nlohmann::json()) != judged.value(member, nlohmann::json())) {
      std::printf("result.json differs in its %s\n", member);
      return kExitFail;
    }
  }
  std::printf("%-13s identical\n", "verdict");
  return kExitPass;
}

// BBMC's runs are judged in memory, those of another controller as whole runs.
ShrunkCase shrunk_case(const ExperimentFixture& fixture, const RunOptions& options) {
  if (!options.external && options.firmware.empty()) {
    return shrink(fixture, *options.seed);
  }
  auto plain = fixture;
  plain.experiment.seed = *options.seed;
  return shrink(plain, [&](const ExperimentFixture& smaller) {
    const TemporaryFolder folder;
    auto trial = options;
    trial.out = folder.path();
    const auto run = run_experiment(smaller, trial);
    return run.complete ? run.judgement.checks : std::vector<Check>{};
  });
}

// The smallest run that fails in the same way, as a run folder of its own.
int shrink_run(const ExperimentFixture& fixture, RunOptions run_options,
               const ReplayOptions& options) {
  const auto shrunk = shrunk_case(fixture, run_options);
  run_options.out = options.out.empty() ? "runs" : options.out;
  const auto run = run_experiment(shrunk.fixture, run_options);
  const bool reproduces = std::any_of(
      run.judgement.checks.begin(), run.judgement.checks.end(), [&](const Check& check) {
        return check.name == shrunk.rule && check.verdict == Verdict::kFail;
      });
  const auto& experiment = shrunk.fixture.experiment;
  std::printf("%s in %zu trials: %zu faults, %zu console lines, %zu events\n  %s\n",
              shrunk.rule.c_str(), shrunk.trials, experiment.faults.size(),
              experiment.console.size(), experiment.events.size(), shrunk.reason.c_str());
  std::ifstream stream(run.folder / "result.json");
  const auto result = nlohmann::json::parse(stream, nullptr, false);
  std::printf("%s\n", (run.folder / result.at("experiment").at("file").get<std::string>()).c_str());
  if (!reproduces) {
    std::fprintf(stderr, "towbench: the smaller run does not fail in the same way\n");
    return kExitRuntime;
  }
  return kExitFail;  // what was shrunk fails
}

// What a run by the wall clock heard decides what it did: it is played again from that.
int replay_inputs(const ExperimentFixture& fixture, std::uint64_t seed,
                  const ReplayOptions& options) {
  if (options.carrier != "in-process") {
    throw FixtureError({"command line", 0, "--carrier"}, '"' + options.carrier + '"',
                       "nothing: a run by the wall clock is replayed from what its sides heard");
  }
  TemporaryFolder temporary;
  const auto out = options.out.empty() ? temporary.path() : std::filesystem::path(options.out);
  const auto run = replay_by_inputs(fixture, seed, options.folder, out);
  const int exit_code = compare(options.folder, run);
  if (!options.out.empty()) {
    std::printf("%s\n", run.folder.c_str());
  }
  return exit_code;
}

// A record that was changed has nothing to compare with. Says so, and false.
bool is_as_recorded(const std::filesystem::path& folder) {
  auto manifest = check_manifest(folder);
  if (!manifest.present) {
    manifest.problems.emplace_back("manifest.json is missing: the record cannot be checked.");
  }
  for (const auto& problem : manifest.problems) {
    std::fprintf(stderr, "towbench: %s\n", problem.c_str());
  }
  if (manifest.problems.empty() && manifest.origin == Origin::kUnknown) {
    std::printf("origin: %s\n", std::string(sentence_for(manifest.origin)).c_str());
  }
  return manifest.problems.empty();
}

// Who controlled, beside BBMC: what is not in the folder cannot be played again.
void choose_recorded_controller(const std::filesystem::path& folder, const Recorded& recorded,
                                RunOptions& options) {
  constexpr std::string_view kProcess = "process:";
  const auto& carrier = recorded.carrier;
  if (recorded.by_wall_clock &&
      (carrier.starts_with(kProcess) || carrier.starts_with("external:"))) {
    throw FixtureError({(folder / "result.json").string(), 0, "clock"}, "\"real\"",
                       "a run in lockstep: another controller does not do the same twice by the "
                       "wall clock");
  }
  if (recorded.typed_by_hand) {
    throw FixtureError({(folder / "result.json").string(), 0, "checks"}, "\"driven_by_hand\"",
                       "a run by the experiment's console: what a person types at an image's "
                       "console is not played again");
  }
  if (carrier.starts_with(kProcess)) {
    options.external = ExternalController{.command = carrier.substr(kProcess.size())};
  } else if (carrier == "virtual board" && !recorded.image.empty()) {
    options.firmware = recorded.image;
  } else if (carrier == "virtual board" || carrier.starts_with("external:")) {
    throw FixtureError({(folder / "result.json").string(), 0, "carrier"}, '"' + carrier + '"',
                       "a run whose controller the folder holds or names: this one does not; "
                       "run the experiment in its inputs with --controller");
  }
}

int execute_replay(const ReplayOptions& options) {
  const std::filesystem::path folder = options.folder;
  const auto recorded = recorded_in(folder);
  if (!is_as_recorded(folder)) {
    return kExitInvalid;
  }
  const auto fixture = load_experiment(recorded.experiment);
  RunOptions run_options;
  choose_recorded_controller(folder, recorded, run_options);
  if (options.shrink && !recorded.by_wall_clock) {
    run_options.seed = recorded.seed;
    return shrink_run(fixture, run_options, options);
  }
  if (recorded.by_wall_clock) {
    return replay_inputs(fixture, recorded.seed, options);
  }
  const bool temporary = options.out.empty();
  run_options.out = temporary ? make_temporary_folder() : std::filesystem::path(options.out);
  run_options.seed = recorded.seed;
  choose_carrier(options.carrier, run_options);
  run_options.watchers.stop = &stop_requested();
  const auto run = run_experiment(fixture, run_options);
  const int exit_code = graver(compare(folder, run), compare_verdicts(folder, run));
  if (temporary) {
    std::filesystem::remove_all(run_options.out);
  } else {
    std::printf("%s\n", run.folder.c_str());
  }
  return exit_code;
}

}  // namespace

void add_replay(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ReplayOptions>();
  auto* verb = app.add_subcommand("replay", "run a folder's inputs again and compare the records");
  verb->add_option("folder", options->folder, "a complete run folder")->required();
  verb->add_option("--out", options->out, "keep the replayed run below this folder")
      ->check(folder_to_write());
  verb->add_option("--carrier", options->carrier, kCarrierHelp)->capture_default_str();
  verb->add_flag("--shrink", options->shrink,
                 "instead: find the smallest run that breaks the same requirement, and run it");
  verb->footer("Example: towbench replay runs/20250131T120000Z-circle-1a2b3c4d");
  verb->callback([options, &exit_code] { exit_code = execute_replay(*options); });
}

}  // namespace towbench::harness
