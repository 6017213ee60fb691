// towbench campaign: faults x phases of motion x seeds, in parallel, one verdict.
#include "harness/campaign/campaign.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "harness/campaign/campaign_report.h"
#include "harness/campaign/drawn_machines.h"
#include "harness/campaign/kept_runs.h"
#include "harness/campaign/results_file.h"
#include "harness/campaign/shell_words.h"
#include "harness/campaign/slurm_array.h"
#include "harness/campaign/worker_pool.h"
#include "harness/commands/campaign_shard.h"
#include "harness/commands/command.h"
#include "harness/commands/exit_codes.h"
#include "harness/commands/experiment_options.h"
#include "harness/commands/option_checks.h"
#include "harness/commands/progress_line.h"
#include "harness/commands/stop_signal.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/record/line_writer.h"

namespace towbench::harness {
namespace {

struct CampaignOptions {
  std::string campaign = "standard";
  std::string out;  // empty: default_folder()
  std::string shard = "1/1";
  std::string only;
  std::string keep;
  std::string controller;
  std::vector<std::string> slurm_options;
  std::uint64_t seeds = 0;
  std::size_t workers = 0;
  std::size_t slurm = 0;
  bool fresh = false;
  bool quiet = false;
};

// Results of BBMC are kept for the next call.
const char* default_folder(const CampaignOptions& options) {
  return options.controller.empty() ? "runs/campaign" : "runs/campaign-of-controller";
}

std::filesystem::path find_campaign(const std::string& named) {
  if (named.find('/') != std::string::npos || named.ends_with(".toml")) {
    return named;
  }
  const auto of_machine = fixtures_directory() / "machines" / named / "campaign.toml";
  return std::filesystem::exists(of_machine)
             ? of_machine
             : fixtures_directory() / "campaigns" / (named + ".toml");
}

// Runs what is left of this shard here.
void run_here(const CampaignOptions& options, const Campaign& campaign,
              const std::vector<CampaignCase>& cases, const Shard& shard) {
  const std::filesystem::path folder = options.out;
  const auto file = folder / results_file(shard);
  const auto workers = options.workers > 0
                           ? options.workers
                           : std::max<std::size_t>(1, std::thread::hardware_concurrency());
  // Appends: what an interrupted campaign left is kept.
  ResultsFile results(file);
  ProgressLine progress(!options.quiet);
  std::size_t done = 0;
  const auto a_minute = [&] { return 60.0 * static_cast<double>(done) / progress.elapsed_s(); };
  run_in_workers(campaign, cases, workers, stop_requested(), [&](const std::string& line) {
    results.append(line);
    ++done;
    progress.show_sometimes([&] {
      return fmt::format("{} of {} cases, {:.0f} a minute", done, cases.size(), a_minute());
    });
  });
  progress.clear();
  if (!options.quiet && done > 0) {
    std::printf("%zu cases in %.1f s with %zu workers: %.0f a minute\n", done, progress.elapsed_s(),
                workers, a_minute());
  }
}

// Shards of which a case has no result yet.
std::vector<std::size_t> unfinished(const CampaignOptions& options, const Campaign& campaign,
                                    const std::vector<CampaignCase>& all) {
  const auto results = load_results(options.out, campaign.fingerprint);
  std::vector<std::size_t> shards;
  for (std::size_t index = 1; index <= options.slurm; ++index) {
    if (!left_over(all, options.only, {index, options.slurm}, results).empty()) {
      shards.push_back(index);
    }
  }
  return shards;
}

// As a job array; a task that was lost is submitted again, as long as that helps.
void run_on_slurm(const CampaignOptions& options, const Campaign& campaign,
                  const std::vector<CampaignCase>& all) {
  SlurmArray array{.name = campaign.name,
                   .tasks = options.slurm,
                   .program = std::filesystem::canonical("/proc/self/exe"),
                   .arguments = {"campaign", std::filesystem::absolute(campaign.file).string()},
                   .folder = std::filesystem::absolute(options.out),
                   .directives = options.slurm_options};
  if (options.seeds != 0) {
    array.arguments.insert(array.arguments.end(), {"--seeds", std::to_string(options.seeds)});
  }
  if (!options.controller.empty()) {
    array.arguments.insert(array.arguments.end(), {"--controller", options.controller});
  }
  if (!options.only.empty()) {
    array.arguments.insert(array.arguments.end(), {"--only", options.only});
  }
  auto shards = unfinished(options, campaign, all);
  while (!shards.empty() && !stop_requested()) {
    const auto before = load_results(options.out, campaign.fingerprint).size();
    const auto job = submit_and_wait(array, shards, stop_requested());
    if (!options.quiet && !job.empty()) {
      std::printf("job %s: %zu of %zu shards\n", job.c_str(), shards.size(), options.slurm);
    }
    shards = unfinished(options, campaign, all);
    if (!shards.empty() && load_results(options.out, campaign.fingerprint).size() == before) {
      std::fprintf(stderr, "towbench: shards %s gave no result; see %s\n",
                   fmt::format("{}", fmt::join(shards, ", ")).c_str(),
                   (array.folder / "slurm").c_str());
      return;
    }
  }
}

// Everything, or what this shard has written: the others may be running.
void remove_results(const std::filesystem::path& folder, const Shard& shard) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto name = entry.path().filename().string();
    const bool any = name.starts_with("results") && name.ends_with(".jsonl");
    if (shard.of == 1 ? any : name == results_file(shard)) {
      std::filesystem::remove(entry.path());
    }
  }
}

// Which command keeps any case's run, in the words of this campaign's call.
std::string keep_command(const CampaignOptions& options) {
  const auto seeds = options.seeds == 0 ? "" : fmt::format(" --seeds {}", options.seeds);
  const auto controller =
      options.controller.empty() ? "" : " --controller " + shell_quoted(options.controller);
  return fmt::format("./towbench campaign {}{}{} --out {} --keep CASE", options.campaign, seeds,
                     controller, options.out);
}

int keep_one(const CampaignOptions& options, const Campaign& campaign,
             const std::vector<CampaignCase>& all) {
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const CampaignCase& one) { return one.id == options.keep; });
  if (found == all.end()) {
    throw FixtureError({"--keep"}, '"' + options.keep + '"', "the name of a case of this campaign");
  }
  // At the moment where its fault takes effect, which the case itself finds out.
  const auto line = nlohmann::json::parse(run_campaign_case(campaign, *found));
  std::printf("%s\n", keep_run(campaign, case_of(line), options.out).c_str());
  return kExitPass;
}

// All results there are, as matrix.md, with the runs that are worth keeping.
int report_all(const CampaignOptions& options, const Campaign& campaign,
               const std::vector<CampaignCase>& all, const Shard& shard) {
  const bool whole = shard.of == 1 && options.only.empty();
  const std::filesystem::path folder = options.out;
  const auto results = load_results(folder, campaign.fingerprint);
  auto sum = summary_of(results);
  CampaignReport report;
  report.title = campaign.title;
  report.controller = options.controller;
  report.refused = campaign.refused;
  sum.missing = left_over(all, options.only, shard, results).size();
  report.sum = sum;
  report.again = [&](const nlohmann::json& line) { return command_of(campaign, line, folder); };
  report.keep_command = keep_command(options);
  if (whole && !stop_requested()) {
    report.kept = keep_runs(campaign, results, folder);
  }
  if (whole || !options.only.empty()) {
    write_atomically(folder / "matrix.md", campaign_report(report, results));
  }
  std::printf(
      "%-7s  %s: %zu cases, %zu fired, %zu detected, %zu handled, %zu failed, %zu invalid\n",
      std::string(name_of(sum.verdict())).c_str(), campaign.name.c_str(), sum.cases, sum.fired,
      sum.detected, sum.handled, sum.failed, sum.invalid);
  if (sum.missing > 0) {
    std::printf("%zu cases have no result\n", sum.missing);
  }
  std::printf("%s\n", (whole ? folder / "matrix.md" : folder).c_str());
  if (stop_requested()) {
    return kExitRuntime;
  }
  int exit_code = exit_code_of(sum.verdict());
  for (const auto& entry : entries_without_cases(campaign)) {
    std::printf("INVALID  %s: no motion has such a phase, so nothing was tried\n", entry.c_str());
    exit_code = graver(exit_code, kExitInvalid);
  }
  return exit_code;
}

CandidateController controller_of(const std::string& text) {
  RunOptions options;
  choose_controller(text, options);
  if (options.external && options.external->address) {
    throw FixtureError({"command line", 0, "--controller"}, '"' + text + '"',
                       "process:COMMAND or firmware:IMAGE.elf: a campaign starts its controller "
                       "again for every case");
  }
  return {.external = options.external, .firmware = options.firmware, .text = text};
}

int execute_campaign(CampaignOptions& options) {
  if (options.out.empty()) {
    options.out = default_folder(options);
  }
  const auto shard = parse_shard(options.shard);
  auto campaign = load_campaign(find_campaign(options.campaign), options.seeds,
                                controller_of(options.controller));
  const std::filesystem::path folder = options.out;
  std::filesystem::create_directories(folder);
  campaign.drawn = std::make_unique<DrawnMachines>(campaign, folder);
  const auto all = cases_of(campaign);
  if (!options.keep.empty()) {
    return keep_one(options, campaign, all);
  }
  // What a command runs may have changed without its name.
  if (options.fresh || campaign.controller.external) {
    remove_results(folder, shard);
  }
  if (options.slurm > 0) {
    run_on_slurm(options, campaign, all);
  } else {
    const auto results = load_results(folder, campaign.fingerprint);
    run_here(options, campaign, left_over(all, options.only, shard, results), shard);
  }
  return report_all(options, campaign, all, shard);
}

}  // namespace

void add_campaign(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CampaignOptions>();
  auto* verb = app.add_subcommand("campaign", "run a fault-injection campaign");
  verb->add_option(
          "campaign", options->campaign,
          "name of a campaign of fixtures/campaigns, of a machine of fixtures/machines, or "
          "a path")
      ->capture_default_str();
  verb->add_option(
          "--out", options->out,
          "folder of results and matrix.md; what is there already is not run again, but of "
          "a program of your own [runs/campaign; with --controller "
          "runs/campaign-of-controller]")
      ->check(folder_to_write());
  verb->add_option(
      "--controller", options->controller,
      "instead of BBMC: process:\"COMMAND {address}\", a program that the bench starts "
      "for every case; firmware:IMAGE.elf, an image on the virtual AM335x");
  verb->add_option("--shard", options->shard, "i/n: every n-th case, from the i-th on")
      ->capture_default_str();
  verb->add_option("--workers", options->workers, "processes; as many as cores when 0")
      ->check(whole_number());
  verb->add_option("--seeds", options->seeds,
                   "cases of each combination, instead of the file's numbers")
      ->check(whole_number());
  verb->add_option("--only", options->only, "cases whose name holds this text");
  verb->add_option("--keep", options->keep,
                   "run the case of this name alone, into a run folder with a report");
  auto* slurm =
      verb->add_option("--slurm", options->slurm,
                       "as a Slurm job array of so many tasks; --out is seen by all nodes");
  slurm->check(CLI::Range(1, 10000))->excludes("--shard")->excludes("--workers");
  verb->add_option("--slurm-option", options->slurm_options,
                   "one more #SBATCH line, such as --partition=main")
      ->needs(slurm);
  verb->add_flag("--fresh", options->fresh, "run everything again");
  verb->add_flag("-q,--quiet", options->quiet, "print the verdict and the report's path only");
  verb->footer("Example: towbench campaign standard --seeds 3 --shard 1/4 --out runs/campaign");
  verb->callback([options, &exit_code] { exit_code = execute_campaign(*options); });
}

}  // namespace towbench::harness
