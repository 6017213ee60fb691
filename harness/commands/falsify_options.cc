#include "harness/commands/falsify_options.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <regex>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/commands/experiment_options.h"
#include "harness/run/run_carrier.h"

namespace towbench::harness {
namespace {

bool says_a_speed(const Experiment& experiment) {
  return std::any_of(experiment.console.begin(), experiment.console.end(),
                     [](const ConsoleStep& step) {
                       return step.send.find("--speed") != std::string::npos ||
                              step.send.find("--period") != std::string::npos;
                     }) ||
         std::any_of(experiment.reference.begin(), experiment.reference.end(),
                     [](const ReferenceMotion& motion) { return motion.speed_m_per_s > 0; });
}

}  // namespace

SearchBudget parse_budget(const std::string& text) {
  static const std::regex kBudget(R"(\s*(\d{1,9}(?:\.\d{1,3})?)\s*(runs|min|s|h)?\s*)");
  std::smatch found;
  if (std::regex_match(text, found, kBudget)) {
    const double number = std::stod(found[1]);
    const auto unit = found[2].str();
    if (number > 0 && (unit.empty() || unit == "runs") && number == std::floor(number)) {
      return {static_cast<std::size_t>(number), 0};
    }
    if (number > 0 && !unit.empty() && unit != "runs") {
      constexpr std::size_t kAnyNumber = 1'000'000'000;
      return {kAnyNumber, number * (unit == "h" ? 3600 : unit == "min" ? 60 : 1)};
    }
  }
  throw FixtureError({.file = "command line", .key = "--budget"}, '"' + text + '"',
                     "a number above 0 with runs, s, min or h: \"2000 runs\", \"10 min\"");
}

Optimiser optimiser_named(const std::string& text) {
  const auto* const name = std::find(std::begin(kOptimiserNames), std::end(kOptimiserNames), text);
  if (name == std::end(kOptimiserNames)) {
    throw FixtureError({.file = "command line", .key = "--optimiser"}, '"' + text + '"',
                       fmt::format("{}", fmt::join(kOptimiserNames, ", ")));
  }
  return static_cast<Optimiser>(name - std::begin(kOptimiserNames));
}

Asked asked_of(const FalsifyOptions& options, const Experiment& experiment) {
  if (options.requirement == "rules") {
    return {};
  }
  std::vector<const Requirement*> fitting;
  std::string ids = "rules";
  for (const auto& requirement : experiment.requirements) {
    ids += ' ' + requirement.id;
    if (options.requirement.empty() ? requirement.under_faults
                                    : requirement.id == options.requirement) {
      fitting.push_back(&requirement);
    }
  }
  if (fitting.size() == 1) {
    return {.requirement = *fitting.front()};
  }
  if (fitting.empty() && options.requirement.empty()) {
    return {};
  }
  throw FixtureError({.file = "command line", .key = "--requirement"},
                     options.requirement.empty() ? "none, and several of the experiment apply"
                                                 : '"' + options.requirement + '"',
                     "one of: " + ids);
}

CandidateController candidate_of(const std::string& text) {
  RunOptions options;
  choose_controller(text, options);
  if (options.external && options.external->address) {
    throw FixtureError({"command line", 0, "--controller"}, '"' + text + '"',
                       "process:COMMAND or firmware:IMAGE.elf: it is started again for every run");
  }
  return {.external = options.external, .firmware = options.firmware, .text = text};
}

bool searches_no_fault(const FalsifyOptions& options) {
  return options.faults == std::vector<std::string>{"none"};
}

void check_setup(FalsifyOptions& options, const ExperimentFixture& fixture, const Asked& asked,
                 const CandidateController& controller) {
  auto& setup = options.setup;
  const auto refuse = [](const char* key, std::string given, const char* allowed) {
    throw FixtureError({.file = "command line", .key = key}, std::move(given), allowed);
  };
  if (!options.speed.empty()) {
    setup.speed = {options.speed.front(), options.speed.back()};
    if (!(setup.speed.first > 0 && setup.speed.first < setup.speed.second &&
          setup.speed.second <= 10)) {
      refuse("--speed", fmt::format("{}", fmt::join(options.speed, " ")), "0 < FROM < TO <= 10");
    }
    if (!says_a_speed(fixture.experiment)) {
      refuse("--speed", "an experiment whose motions state none", "one with --speed or --period");
    }
  }
  if (!setup.typed.empty() && !controller.is_bbmc()) {
    refuse("--typed", '"' + setup.typed + '"',
           "BBMC alone: another controller has no console here");
  }
  const bool varies =
      setup.machine > 0 || setup.start_m > 0 || !options.speed.empty() || !setup.typed.empty();
  if (options.snapshots > 0 && options.workers > 1) {
    refuse("--snapshots", fmt::format("{}", options.snapshots), "0 with --workers");
  }
  if (options.snapshots > 0 && varies) {
    refuse("--snapshots", fmt::format("{}", options.snapshots),
           "0 where the setup varies: each run begins anew");
  }
  if (searches_no_fault(options) && (!varies || !asked.requirement || !options.second.empty())) {
    refuse("--faults", "none",
           "none with --machine, --start, --speed or --typed, and a [[requirement]] that is asked");
  }
}

}  // namespace towbench::harness
