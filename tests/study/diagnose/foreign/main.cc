// Hides effects in machines of several makers, under drawn plans, and counts the right answers.
//
// One line of CSV a case on the output, tables on the error stream at the end. The same seed gives
// the same case, whatever the number of workers.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tests/study/diagnose/foreign/score.h"
#include "tests/study/diagnose/foreign/sources.h"
#include "tests/study/diagnose/foreign/write_case.h"

namespace {

using namespace towbench::tests::foreign;

struct Options {
  int cases = 10;
  std::uint64_t seed = 1;
  std::string generator = "foreign";
  std::string scale = "physical";
  Wish wish;
  int workers = 1;
  std::string folder;
  bool draw_only = false;
};

struct Result {
  Posed posed;
  Answer answer;
  Judged judged;
  double seconds = 0;
  std::string failure;
};

Result run_case(const Options& options, std::uint64_t seed) {
  Result out;
  try {
    if (!options.folder.empty()) {
      const DrawnCase drawn = draw_case(options.wish, seed);
      write_case(drawn, std::filesystem::path(options.folder) / fmt::format("seed_{}", seed));
      out.posed = pose(options.wish, drawn);
    } else {
      out.posed = pose(options.generator, options.wish, seed);
    }
    if (!options.draw_only) {
      const auto start = std::chrono::steady_clock::now();
      out.answer = answer_of(towbench::study::diagnose::diagnose(out.posed.request));
      out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      out.judged = judge(out.posed.hidden, out.posed.is_outside, out.answer);
    }
    out.posed.request = {};  // the logs are large
  } catch (const std::exception& error) {
    out.failure = error.what();
  }
  return out;
}

std::string effects_of(const Posed& posed) {
  std::string all;
  for (const Key& key : posed.hidden) {
    all += (all.empty() ? "" : "+") + key.name;
  }
  return all.empty() ? "none" : all;
}

constexpr const char* kHeader =
    "seed,generator,machine,plan,sessions,rate_Hz,resolution_m,effect,strength,visible_times,"
    "share_pct,redrawn,answer,unexplained,adequate,outcome,false_names,least_p,gain_pct,seconds,"
    "note\n";

std::string line_of(const Options& options, std::uint64_t seed, const Result& r) {
  double least_p = 1;
  for (const Named& cause : r.answer.causes) {
    least_p = std::min(least_p, cause.p_value);
  }
  const Posed& p = r.posed;
  const std::string note = r.failure.empty() ? r.answer.refusal : r.failure;
  return fmt::format(
      "{},{},{},{},{},{:.0f},{:.3g},{},{},{:.3g},{:.3g},{},{},{},{},{},{},{:.2g},{:.4g},{:.1f},{}"
      "\n",
      seed, options.generator, p.machine, p.plan, p.sessions, p.rate_Hz, p.resolution_m,
      effects_of(p), options.wish.strength, p.visible, 100 * p.share, p.redrawn, r.answer.words(),
      r.answer.unexplained ? 1 : 0, r.answer.adequate ? 1 : 0,
      kOutcomes[static_cast<std::size_t>(r.judged.outcome)], fmt::join(r.judged.false_names, " "),
      least_p, r.answer.gain_pct, r.seconds, note);
}

void count(Tally& tally, const Result& r) {
  const auto add = [&](const char* table, const std::string& row) {
    tally.add(table, row, r.judged, r.answer.unexplained);
  };
  add("all", "all");
  tally.add(r.judged.said);
  add("machine", r.posed.machine);
  for (const Key& key : r.posed.hidden) add("hidden", key.name);
  if (r.posed.hidden.empty()) add("hidden", "none");
  for (const std::string& motion : r.posed.motions) add("with a run of", motion);
}

// Workers take the next seed; lines are printed in the order of the seeds.
class Campaign {
 public:
  explicit Campaign(const Options& options)
      : options_(options), done_(static_cast<std::size_t>(options.cases)) {}

  int run() {
    std::fputs(kHeader, stdout);
    std::vector<std::thread> workers;
    for (int i = 0; i < options_.workers; ++i) {
      workers.emplace_back([this] { work(); });
    }
    for (std::thread& worker : workers) {
      worker.join();
    }
    fmt::print(stderr,
               "{}\n{} cases; {} draws were set aside because they did not show what they "
               "hid or did not move; {} cases could not be drawn or run\n",
               tally_.words(), options_.cases, redrawn_, failed_);
    return failed_ == options_.cases ? 4 : 0;
  }

 private:
  void work() {
    for (int i = next_++; i < options_.cases; i = next_++) {
      const auto slot = static_cast<std::size_t>(i);
      Result result = run_case(options_, options_.seed + slot);
      const std::lock_guard lock(mutex_);
      done_[slot] = std::move(result);
      ready_[slot] = true;
      for (; printed_ < done_.size() && ready_[printed_]; ++printed_) {
        print(printed_);
      }
    }
  }
  void print(std::size_t slot) {
    const Result& result = done_[slot];
    std::fputs(line_of(options_, options_.seed + slot, result).c_str(), stdout);
    std::fflush(stdout);
    redrawn_ += result.posed.redrawn;
    if (result.failure.empty()) {
      count(tally_, result);
    } else {
      ++failed_;
    }
  }

  const Options& options_;
  std::vector<Result> done_;
  std::vector<char> ready_ = std::vector<char>(done_.size());
  std::size_t printed_ = 0;
  std::atomic<int> next_{0};
  std::mutex mutex_;
  Tally tally_;
  int redrawn_ = 0;
  int failed_ = 0;
};

void add_options(CLI::App& app, Options& options) {
  app.add_option("--cases", options.cases, "how many, from the first seed on")
      ->check(CLI::Range(1, 1'000'000));
  app.add_option("--seed", options.seed, "the first seed");
  app.add_option("--kind", options.wish.kind, "what is hidden")
      ->check(CLI::IsMember({"none", "one", "pair", "outside"}));
  app.add_option("--strength", options.wish.strength, "times full strength")
      ->check(CLI::Range(0.01, 10.0));
  app.add_option("--scale", options.scale, "full strength: physical sizes, or times detectable")
      ->check(CLI::IsMember({"physical", "detectable"}));
  app.add_option("--generator", options.generator, "whose machine")
      ->check(CLI::IsMember({"foreign", "hidden_axis", "bench"}));
  app.add_option("--machine", options.wish.machine, "kind of machine; default: drawn")
      ->check(CLI::IsMember(machine_kinds()));
  app.add_option("--plan", options.wish.motion, "motion of every run; default: drawn for each");
  app.add_option("--effect", options.wish.effect, "default: drawn");
  app.add_option("--workers", options.workers, "threads")->check(CLI::Range(1, 64));
  app.add_option("--write", options.folder, "folder for the cases as files");
  app.add_flag("--draw-only", options.draw_only, "diagnose nothing");
}

int refuse(const char* option, const std::string& given, const std::vector<std::string>& allowed) {
  fmt::print(stderr, "{}: {}: allowed are {}\n", option, given, fmt::join(allowed, ", "));
  return 2;
}

int check(Options& options) {
  options.wish.scale = options.scale == "physical" ? Scale::kPhysical : Scale::kDetectable;
  std::vector<std::string> motions = motion_names();
  const bool is_foreign = options.generator == "foreign";
  if (!is_foreign) motions = {"open_loop"};
  if (!options.wish.motion.empty() &&
      std::find(motions.begin(), motions.end(), options.wish.motion) == motions.end()) {
    return refuse("--plan", options.wish.motion, motions);
  }
  if (is_foreign && !options.wish.effect.empty()) {
    std::vector<std::string> names;
    for (const Effect& effect : effects()) {
      if ((effect.family == "outside") == (options.wish.kind == "outside")) {
        names.push_back(effect.name);
      }
    }
    if (std::find(names.begin(), names.end(), options.wish.effect) == names.end()) {
      return refuse("--effect", options.wish.effect, names);
    }
  }
  if (!is_foreign && !options.folder.empty()) {
    return refuse("--write", options.folder, {"for --generator foreign"});
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("counts right answers of the diagnosis on machines of several makers");
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  if (const int refused = check(options)) {
    return refused;
  }
  return Campaign(options).run();
}
