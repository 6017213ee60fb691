// towbench campaign: faults x phases of motion x seeds, in parallel, one verdict.
#include "harness/campaign/campaign.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <set>
#include <thread>

#include <fmt/format.h>
#include <unistd.h>

#include "harness/campaign/campaign_report.h"
#include "harness/campaign/worker_pool.h"
#include "harness/commands/command.h"
#include "harness/commands/fixture_paths.h"
#include "harness/commands/stop_signal.h"
#include "harness/record/line_writer.h"

namespace towbench::harness {
namespace {

struct Options {
  std::string campaign = "standard";
  std::string out = "runs/campaign";
  std::string shard = "1/1";
  std::string only;
  std::uint64_t seeds = 0;
  std::size_t workers = 0;
  bool fresh = false;
  bool quiet = false;
};

struct Shard {
  std::size_t index = 1;
  std::size_t of = 1;
};

Shard parse_shard(const std::string& text) {
  Shard shard;
  char end = 0;
  const bool read = std::sscanf(text.c_str(), "%zu/%zu%c", &shard.index, &shard.of, &end) == 2;
  if (!read || shard.index < 1 || shard.index > shard.of) {
    throw FixtureError({"--shard"}, '"' + text + '"', "i/n with 1 <= i <= n");
  }
  return shard;
}

std::filesystem::path find_campaign(const std::string& named) {
  const bool is_path = named.find('/') != std::string::npos || named.ends_with(".toml");
  return is_path ? std::filesystem::path(named)
                 : fixtures_directory() / "campaigns" / (named + ".toml");
}

// This shard's cases that have no result yet.
std::vector<CampaignCase> left_over(const std::vector<CampaignCase>& all, const Options& options,
                                    const Shard& shard,
                                    const std::vector<nlohmann::json>& results) {
  std::set<std::string> done;
  for (const auto& line : results) {
    done.insert(line.value("case", ""));
  }
  std::vector<CampaignCase> left;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool mine = i % shard.of == shard.index - 1;
    const bool wanted = options.only.empty() || all[i].id.find(options.only) != std::string::npos;
    if (mine && wanted && !done.contains(all[i].id)) {
      left.push_back(all[i]);
    }
  }
  return left;
}

class Progress {
 public:
  Progress(std::size_t cases, bool wanted)
      : cases_(cases), wanted_(wanted && isatty(STDERR_FILENO) == 1) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() {
    if (wanted_) {
      std::fputs("\r\033[K", stderr);
    }
  }
  void step() {
    ++done_;
    if (wanted_ && done_ % 16 == 0) {
      std::fprintf(stderr, "\r%zu of %zu cases, %.0f a minute\033[K", done_, cases_,
                   60.0 * static_cast<double>(done_) / elapsed_s());
    }
  }
  [[nodiscard]] double elapsed_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  [[nodiscard]] std::size_t done() const noexcept { return done_; }

 private:
  std::size_t cases_;
  bool wanted_;
  std::size_t done_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

int execute(const Options& options) {
  const auto shard = parse_shard(options.shard);
  const auto campaign = load_campaign(find_campaign(options.campaign), options.seeds);
  const auto all = cases_of(campaign);
  const std::filesystem::path folder = options.out;
  std::filesystem::create_directories(folder);
  const auto file =
      folder / (shard.of == 1 ? std::string("results.jsonl")
                              : fmt::format("results-{}-of-{}.jsonl", shard.index, shard.of));
  if (options.fresh) {
    std::filesystem::remove(file);
  }
  const auto cases = left_over(all, options, shard, load_results(folder));
  const auto workers = options.workers > 0
                           ? options.workers
                           : std::max<std::size_t>(1, std::thread::hardware_concurrency());
  {
    // Appends: what an interrupted campaign left is kept.
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> results(std::fopen(file.c_str(), "a"),
                                                            &std::fclose);
    if (!results) {
      throw std::runtime_error(file.string() + " cannot be written");
    }
    Progress progress(cases.size(), !options.quiet);
    run_in_workers(campaign, cases, workers, stop_requested(), [&](const std::string& line) {
      std::fprintf(results.get(), "%s\n", line.c_str());
      std::fflush(results.get());
      progress.step();
    });
    if (!options.quiet && progress.done() > 0) {
      std::printf("%zu cases in %.1f s with %zu workers: %.0f a minute\n", progress.done(),
                  progress.elapsed_s(), workers,
                  60.0 * static_cast<double>(progress.done()) / progress.elapsed_s());
    }
  }
  const auto results = load_results(folder);
  const auto sum = summary_of(results);
  const bool whole = shard.of == 1 && options.only.empty();
  const auto missing = whole && all.size() > sum.cases ? all.size() - sum.cases : 0;
  write_atomically(folder / "matrix.md",
                   campaign_report(campaign.title, results, campaign.incapable, missing));
  std::printf(
      "%-7s  %s: %zu cases, %zu fired, %zu detected, %zu handled, %zu failed, %zu invalid\n",
      std::string(name_of(sum.verdict())).c_str(), campaign.name.c_str(), sum.cases, sum.fired,
      sum.detected, sum.handled, sum.failed, sum.invalid);
  std::printf("%s\n", (folder / "matrix.md").c_str());
  if (stop_requested()) {
    return kExitRuntime;
  }
  return exit_code_of(missing > 0 ? Verdict::kInvalid : sum.verdict());
}

}  // namespace

void add_campaign(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand("campaign", "try faults on motions, by the thousand");
  verb->add_option("campaign", options->campaign,
                   "name of a campaign of fixtures/campaigns, or a path")
      ->capture_default_str();
  verb->add_option("--out", options->out,
                   "folder of results and matrix.md; what is there already is not run again")
      ->capture_default_str();
  verb->add_option("--shard", options->shard, "i/n: every n-th case, from the i-th on")
      ->capture_default_str();
  verb->add_option("--workers", options->workers, "processes; as many as cores when 0");
  verb->add_option("--seeds", options->seeds, "cases of each combination, instead of the file's");
  verb->add_option("--only", options->only, "cases whose name holds this text");
  verb->add_flag("--fresh", options->fresh, "run everything again");
  verb->add_flag("-q,--quiet", options->quiet, "print the verdict and the report's path only");
  verb->footer("Example: towbench campaign standard --seeds 3 --shard 1/4 --out runs/campaign");
  verb->callback([options, &exit_code] { exit_code = execute(*options); });
}

}  // namespace towbench::harness
