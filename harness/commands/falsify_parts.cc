#include "harness/commands/falsify_parts.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/campaign/slurm_array.h"
#include "harness/commands/progress_line.h"
#include "harness/commands/stop_signal.h"

namespace towbench::harness {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t kBetweenParts = 1'000'000'007;

std::filesystem::path trials_file(const std::filesystem::path& folder, const Shard& part) {
  return folder / (part.of == 1 ? std::string("trials.jsonl")
                                : fmt::format("trials-{}-of-{}.jsonl", part.index, part.of));
}

std::size_t runs_of(const Search& search, const Shard& part) {
  const auto runs = search.settings.runs;
  return runs / part.of + (part.index <= runs % part.of ? 1 : 0);
}

FalsifySession session_of(const FalsifyOptions& options, const Search& search, const Shard& part) {
  auto settings = search.settings;
  settings.runs = runs_of(search, part);
  settings.seed += kBetweenParts * (part.index - 1);
  settings.fingerprint += fmt::format(" {}/{}", part.index, part.of);
  return {settings, search.spaces, trials_file(options.out, part)};
}

std::vector<Objective*> objectives_of(const Search& search) {
  std::vector<Objective*> all;
  for (const auto& one : search.objectives) {
    all.push_back(one.get());
  }
  return all;
}

std::string how_far(const FalsifySession& session, const Search& search, std::size_t runs,
                    double elapsed_s) {
  const auto* worst = session.worst();
  const auto best = worst == nullptr
                        ? std::string("no fault took effect yet")
                        : fmt::format("smallest margin {:.4g} {} ({})", *worst->outcome.margin,
                                      search.unit, session.spaces()[worst->space].name());
  const auto of = search.budget.time_s > 0
                      ? fmt::format(", {:.0f} of {:.0f} s", elapsed_s, search.budget.time_s)
                      : fmt::format(" of {} runs", runs);
  return fmt::format("{}{}, {}", session.trials().size(), of, best);
}

void run_part(const FalsifyOptions& options, const Search& search, const Shard& part, bool told) {
  auto session = session_of(options, search, part);
  ProgressLine progress(told);
  const double limit_s = search.budget.time_s;
  (void)session.run(
      objectives_of(search),
      [&] { return !stop_requested() && (limit_s == 0 || progress.elapsed_s() < limit_s); },
      [&](const FalsifySession& now) {
        progress.show_sometimes(
            [&] { return how_far(now, search, runs_of(search, part), progress.elapsed_s()); });
      });
}

// Everything that the parts' files hold.
SearchResult known_result(const FalsifyOptions& options, const Search& search, std::size_t parts) {
  SearchResult all{.session = session_of(options, search, {.index = 1, .of = parts}),
                   .whole = true};
  for (std::size_t i = 1; i <= parts; ++i) {
    auto part = session_of(options, search, {.index = i, .of = parts});
    const bool to_its_end = part.run(
        objectives_of(search), [] { return false; }, [](const auto&) {});
    all.whole = all.whole && (to_its_end || (search.budget.time_s > 0 && !part.trials().empty()));
    all.session.add(part);
  }
  all.whole = all.whole && !stop_requested();
  return all;
}

// Waits for all; what stops this process stops them.
void wait_for(std::vector<pid_t> workers, bool told) {
  ProgressLine progress(told);
  const auto all = workers.size();
  bool stopped = false;
  while (!workers.empty()) {
    if (stop_requested() && !std::exchange(stopped, true)) {
      for (const auto worker : workers) {
        (void)::kill(worker, SIGTERM);
      }
    }
    std::erase_if(workers,
                  [](pid_t worker) { return ::waitpid(worker, nullptr, WNOHANG) == worker; });
    progress.show_sometimes([&] {
      return fmt::format("{} of {} parts at work, {:.0f} s", workers.size(), all,
                         progress.elapsed_s());
    });
    std::this_thread::sleep_for(workers.empty() ? 0ms : 50ms);
  }
}

void run_in_workers(const FalsifyOptions& options, const Search& search) {
  std::fflush(nullptr);
  std::vector<pid_t> workers;
  for (std::size_t i = 1; i <= options.workers; ++i) {
    const auto worker = ::fork();
    if (worker < 0) {
      const int error = errno;
      wait_for(std::move(workers), false);
      throw std::system_error(error, std::generic_category(), "a worker");
    }
    if (worker == 0) {
      int code = 0;
      try {
        run_part(options, search, {.index = i, .of = options.workers}, false);
      } catch (const std::exception& error) {
        std::fprintf(stderr, "towbench: part %zu: %s\n", i, error.what());
        code = 3;
      }
      ::_exit(code);
    }
    workers.push_back(worker);
  }
  wait_for(std::move(workers), !options.quiet);
}

std::vector<std::string> arguments_of(const FalsifyOptions& options) {
  std::vector<std::string> words{"falsify"};
  for (const auto& experiment : options.experiments) {
    words.push_back(experiment);
  }
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) {
      words.insert(words.end(), {name, value});
    }
  };
  add("--requirement", options.requirement);
  add("--faults", fmt::format("{}", fmt::join(options.faults, ",")));
  add("--except", fmt::format("{}", fmt::join(options.except, ",")));
  add("--second", options.second);
  add("--machine", options.setup.machine > 0 ? fmt::format("{}", options.setup.machine) : "");
  add("--start", options.setup.start_m > 0 ? fmt::format("{}", options.setup.start_m) : "");
  if (!options.speed.empty()) {
    words.insert(words.end(), {"--speed", fmt::format("{}", options.speed.front()),
                               fmt::format("{}", options.speed.back())});
  }
  add("--typed", options.setup.typed);
  add("--budget", options.budget);
  add("--optimiser", options.optimiser);
  add("--controller", options.controller);
  add("--seed", fmt::format("{}", options.seed));
  add("--snapshots", fmt::format("{}", options.snapshots));
  if (options.until_broken) {
    words.emplace_back("--until-broken");
  }
  return words;
}

void run_on_slurm(const FalsifyOptions& options) {
  const SlurmArray array{.name = "falsify",
                         .tasks = options.slurm,
                         .program = std::filesystem::canonical("/proc/self/exe"),
                         .arguments = arguments_of(options),
                         .folder = std::filesystem::absolute(options.out),
                         .directives = options.slurm_options};
  std::vector<std::size_t> parts;
  for (std::size_t i = 1; i <= options.slurm; ++i) {
    parts.push_back(i);
  }
  const auto job = submit_and_wait(array, parts, stop_requested());
  if (!options.quiet && !job.empty()) {
    std::printf("job %s: %zu parts\n", job.c_str(), parts.size());
  }
}

}  // namespace

SearchResult run_search(const FalsifyOptions& options, const Search& search) {
  const auto shard = parse_shard(options.shard);
  if (options.slurm > 0) {
    run_on_slurm(options);
    return known_result(options, search, options.slurm);
  }
  if (options.workers > 1) {
    run_in_workers(options, search);
    return known_result(options, search, options.workers);
  }
  run_part(options, search, shard, !options.quiet);
  return known_result(options, search, shard.of);
}

void remove_trials(const std::filesystem::path& folder, const Shard& shard) {
  if (shard.of > 1) {
    std::filesystem::remove(trials_file(folder, shard));
    return;
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto name = entry.path().filename().string();
    if (name.starts_with("trials") && name.ends_with(".jsonl")) {
      std::filesystem::remove(entry.path());
    }
  }
}

}  // namespace towbench::harness
