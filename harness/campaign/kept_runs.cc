#include "harness/campaign/kept_runs.h"

#include <fstream>
#include <set>

#include <fmt/format.h>

#include "harness/campaign/campaign_report.h"
#include "harness/campaign/drawn_machines.h"
#include "harness/campaign/shell_words.h"
#include "harness/fault_cases/faulted_experiment.h"
#include "harness/record/line_writer.h"
#include "harness/report/report.h"
#include "harness/run/run_carrier.h"

namespace towbench::harness {
namespace {

using nlohmann::json;

constexpr std::size_t kMostFailed = 20;
constexpr const char* kIndex = "kept.json";

std::vector<json> wanted(const std::vector<json>& results) {
  std::vector<json> lines;
  std::set<std::string> names;
  const auto want = [&](const json& line) {
    if (names.insert(line.value("case", "")).second) {
      lines.push_back(line);
    }
  };
  for (const auto& [figure, line] : worst_cases(results)) {
    want(line);
  }
  std::size_t failed = 0;
  for (const auto& line : results) {
    if (line.value("verdict", "") != "PASS" && ++failed <= kMostFailed) {
      want(line);
    }
  }
  return lines;
}

// Of this campaign only: another build's folder shows another run.
std::map<std::string, std::string> already_kept(const Campaign& campaign,
                                                const std::filesystem::path& folder) {
  std::map<std::string, std::string> kept;
  std::ifstream stream(folder / kIndex);
  const auto index = json::parse(stream, nullptr, false);
  if (!index.is_object() || index.value("of", "") != campaign.fingerprint) {
    return kept;
  }
  for (const auto& [name, run] : index.at("runs").items()) {
    if (std::filesystem::exists(folder / run.get<std::string>())) {
      kept[name] = run;
    }
  }
  return kept;
}

}  // namespace

CampaignCase case_of(const json& line) {
  return {line.value("case", ""),
          line.value("motion", ""),
          line.value("part", ""),
          line.value("kind", ""),
          line.value("moment", ""),
          line.at("faults").get<std::vector<std::string>>(),
          line.value("machine", std::size_t{0}),
          line.value("carrier", "in-process"),
          {}};
}

ExperimentFixture experiment_of(const Campaign& campaign, const CampaignCase& one,
                                const std::filesystem::path& folder) {
  if (one.is_duty()) {
    throw FixtureError({"--keep"}, '"' + one.id + '"',
                       "a case with a motion; a duty is tried alone by conform --only " + one.kind);
  }
  auto fixture = load_experiment(DrawnMachines::file_of(campaign, folder, one.machine, one.motion));
  add_faults(fixture, plan_of(one));
  return fixture;
}

std::string command_of(const Campaign& campaign, const json& line,
                       const std::filesystem::path& folder) {
  const auto one = case_of(line);
  if (one.is_duty()) {
    return fmt::format("./towbench conform --controller {} --only {}",
                       shell_quoted(campaign.controller.text), one.kind);
  }
  auto text = "./towbench run " +
              DrawnMachines::file_of(campaign, folder, one.machine, one.motion).generic_string();
  if (one.carrier != "in-process") {
    text += " --carrier " + one.carrier;
  }
  if (!campaign.controller.is_bbmc()) {
    text += " --controller " + shell_quoted(campaign.controller.text);
  }
  for (const auto& words : one.faults) {
    text += fmt::format(" --fault \"{}\"", words);
  }
  return text;
}

std::filesystem::path keep_run(const Campaign& campaign, const CampaignCase& one,
                               const std::filesystem::path& folder) {
  RunOptions options;
  options.out = folder / "runs";
  options.program = campaign.program;
  choose_carrier(one.carrier, options);
  choose_candidate(campaign.controller, options);
  const auto run = run_experiment(experiment_of(campaign, one, folder), options);
  (void)write_report(run.folder);  // the folder says all, with a page or without
  return run.folder;
}

std::map<std::string, std::string> keep_runs(const Campaign& campaign,
                                             const std::vector<json>& results,
                                             const std::filesystem::path& folder) {
  auto kept = already_kept(campaign, folder);
  for (const auto& line : wanted(results)) {
    const auto one = case_of(line);
    if (kept.contains(one.id)) {
      continue;
    }
    try {
      kept[one.id] = std::filesystem::proximate(keep_run(campaign, one, folder), folder).string();
    } catch (const FixtureError&) {
      // One that could not be run has no folder to keep; its result says why.
    }
  }
  const json index{{"of", campaign.fingerprint}, {"runs", kept}};
  write_atomically(folder / kIndex, index.dump(2) + '\n');
  return kept;
}

}  // namespace towbench::harness
