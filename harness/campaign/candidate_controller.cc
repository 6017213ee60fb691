#include "harness/campaign/candidate_controller.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "harness/board_bench/reference_board.h"
#include "harness/external/external_run.h"
#include "harness/files/csv_table.h"
#include "harness/record/temporary_folder.h"

namespace towbench::harness {
namespace {

// When the log shows an axis driven for the last time.
double last_drive_s(const std::filesystem::path& folder) {
  const auto log = CsvTable::load(folder / "log.csv");
  const auto time_s = log.column("time_s");
  double last_s = 0;
  for (const auto axis : core::kAllAxes) {
    const auto duty_pct = log.column(fmt::format("{}_duty_pct", core::name_of(axis)));
    for (std::size_t i = 0; i < duty_pct.size(); ++i) {
      last_s = duty_pct[i] != 0.0 ? std::max(last_s, time_s[i]) : last_s;
    }
  }
  return last_s;
}

bool stops_earlier(const std::filesystem::path& folder, const std::filesystem::path& reference) {
  constexpr double kEarlier_s = 0.01;
  try {
    return last_drive_s(folder) < last_drive_s(reference) - kEarlier_s;
  } catch (const CsvError&) {
    return false;  // its checks say what is wrong with it
  }
}

// fault_0_fired: its value is the time.
bool says_when_it_fired(const Check& check) {
  return check.name.starts_with("fault_") && check.name.ends_with("_fired");
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  return bytes.str();
}

// Words of a shell's command, without what quotes mean: enough to find files.
std::vector<std::string> words_of(std::string command) {
  std::replace_if(
      command.begin(), command.end(),
      [](char letter) { return letter == '\'' || letter == '"' || letter == '='; }, ' ');
  std::istringstream stream(command);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) {
    words.push_back(word);
  }
  return words;
}

}  // namespace

void choose_candidate(const CandidateController& controller, RunOptions& options) {
  options.external = controller.external;
  options.firmware = controller.firmware;
}

std::shared_ptr<const ReferenceRun> reference_run_of(const CandidateController& controller,
                                                     const ExperimentFixture& motion) {
  const auto seed = motion.experiment.seed;
  return controller.external
             ? run_external_reference(motion, *controller.external, seed, LoopWatchers{})
             : run_reference_board(motion, controller.firmware, seed);
}

CandidateRun run_candidate(const CandidateController& controller, const ExperimentFixture& motion,
                           const std::shared_ptr<const ReferenceRun>& reference,
                           const std::filesystem::path& out) {
  RunOptions options;
  options.out = out;
  options.reference = reference;
  choose_candidate(controller, options);
  auto result = run_experiment(motion, options);
  CandidateRun run{.folder = std::move(result.folder),
                   .checks = std::move(result.judgement.checks),
                   .complete = result.complete,
                   .reason = std::move(result.reason)};
  run.fired = run.complete && std::all_of(run.checks.begin(), run.checks.end(), [](const auto& it) {
                return !says_when_it_fired(it) || it.verdict == Verdict::kPass;
              });
  return run;
}

CaseVerdict judge_candidate(const CandidateController& controller, const ExperimentFixture& motion,
                            const std::shared_ptr<const ReferenceRun>& reference) {
  const TemporaryFolder folder;
  auto run = run_candidate(controller, motion, reference, folder.path());
  CaseVerdict verdict;
  verdict.checks = std::move(run.checks);
  verdict.fired = run.fired;
  if (!run.complete) {
    verdict.checks.push_back(run_not_complete(run.reason));
    return verdict;
  }
  std::optional<core::Nanoseconds> cause_ns;
  for (const auto& check : verdict.checks) {
    if (says_when_it_fired(check)) {
      const auto fired_ns = core::nanoseconds(check.value.value_or(0));
      cause_ns = cause_ns ? std::min(*cause_ns, fired_ns) : fired_ns;
    } else if (check.name == "kill_to_zero_duty") {
      verdict.figures.kill_to_zero_duty_s = check.value;
    }
  }
  verdict.figures.cause_ns = cause_ns.value_or(0);
  verdict.detected = stops_earlier(run.folder, reference->files.path());
  verdict.handled = verdict.verdict() == Verdict::kPass;
  return verdict;
}

void add_identity(const CandidateController& controller, CanonicalHash& hash) {
  hash.add(controller.text);
  if (!controller.firmware.empty()) {
    hash.add(bytes_of(controller.firmware));
  }
  if (controller.external) {
    for (const auto& word : words_of(controller.external->command)) {
      std::error_code none;
      if (std::filesystem::is_regular_file(word, none)) {
        hash.add(bytes_of(word));
      }
    }
  }
}

}  // namespace towbench::harness
