#include "harness/falsify/falsify_session.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "harness/campaign/results_file.h"
#include "harness/falsify/shuffle.h"

namespace towbench::harness {
namespace {

using nlohmann::json;

// Ends a search from inside: the optimiser lets it through.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted") {}
};

std::string line_of(const FalsifyTrial& trial, const std::string& fingerprint) {
  return json{{"of", fingerprint},
              {"space", trial.space},
              {"point", trial.point},
              {"chosen_by", trial.sample ? kSampleKindNames[static_cast<std::size_t>(*trial.sample)]
                                         : "optimiser"},
              {"tried", trial.tried.words()},
              {"fired", trial.outcome.fired},
              {"margin", trial.outcome.margin ? json(*trial.outcome.margin) : json(nullptr)},
              {"rules", trial.outcome.rules},
              {"broken", trial.outcome.broken},
              {"reason", trial.outcome.reason}}
      .dump(-1, ' ', false, json::error_handler_t::replace);
}

// None when the line is of another trial.
std::optional<Outcome> known_outcome(const std::string& text, const FalsifyTrial& asked) {
  const auto line = json::parse(text, nullptr, false);
  if (!line.is_object() || line.at("space") != asked.space || line.at("point") != asked.point) {
    return std::nullopt;
  }
  Outcome outcome{.fired = line.at("fired"),
                  .broken = line.at("broken"),
                  .reason = line.at("reason"),
                  .rules = line.at("rules")};
  if (!line.at("margin").is_null()) {
    outcome.margin = line.at("margin").get<double>();
  }
  return outcome;
}

std::vector<std::string> lines_of(const std::filesystem::path& file,
                                  const std::string& fingerprint) {
  std::vector<std::string> lines;
  std::ifstream stream(file);
  for (std::string text; std::getline(stream, text);) {
    const auto line = json::parse(text, nullptr, false);
    if (line.is_object() && line.contains("of") && line["of"] == fingerprint) {
      lines.push_back(text);
    }
  }
  return lines;
}

// Every space once, in a drawn order in which all faults come on one experiment before any comes on
// a second.
std::vector<std::size_t> drawn_order(const std::vector<SearchSpace>& spaces, core::Random& random) {
  std::map<std::string, std::vector<std::size_t>> by_fault;
  for (std::size_t i = 0; i < spaces.size(); ++i) {
    by_fault[spaces[i].faults.name()].push_back(i);
  }
  std::vector<std::vector<std::size_t>> left;
  for (auto& [name, of_fault] : by_fault) {
    shuffle(of_fault, random);
    left.push_back(std::move(of_fault));
  }
  std::vector<std::size_t> order;
  while (order.size() < spaces.size()) {
    shuffle(left, random);
    for (auto& of_fault : left) {
      if (!of_fault.empty()) {
        order.push_back(of_fault.back());
        of_fault.pop_back();
      }
    }
  }
  return order;
}

// The optimiser's runs of a round go to one space in so many, each no fewer than it can use.
constexpr std::size_t kNearest = 4;
constexpr std::size_t kLeastRuns = 20;

}  // namespace

FalsifySession::FalsifySession(FalsifySettings settings, std::vector<SearchSpace> spaces,
                               const std::filesystem::path& file)
    : settings_(std::move(settings)),
      spaces_(std::move(spaces)),
      file_(file),
      known_(lines_of(file, settings_.fingerprint)) {
  for (std::size_t i = 0; i < spaces_.size(); ++i) {
    samplers_.emplace_back(spaces_[i].faults.sides(), settings_.seed + 1'000'003 * (i + 1),
                           settings_.optimiser == Optimiser::kUniform);
  }
}

const FalsifyTrial* FalsifySession::worst() const noexcept {
  return worst_ ? &trials_[*worst_] : nullptr;
}

bool FalsifySession::over() const noexcept {
  const bool found = settings_.until_broken && worst_ && trials_[*worst_].outcome.broken;
  return found || trials_.size() >= settings_.runs;
}

FalsifyTrial FalsifySession::measured(std::size_t space, const BoxTrial& asked,
                                      Objective& objective) {
  FalsifyTrial trial{.space = space,
                     .point = asked.point,
                     .sample = asked.sample,
                     .tried = spaces_[space].faults.case_at(asked.point)};
  if (trials_.size() < known_.size()) {
    if (auto known = known_outcome(known_[trials_.size()], trial)) {
      trial.outcome = std::move(*known);
      return trial;
    }
  }
  trial.outcome = objective.measure(trial.tried);
  ResultsFile(file_).append(line_of(trial, settings_.fingerprint));
  return trial;
}

void FalsifySession::take(FalsifyTrial trial) {
  trials_.push_back(std::move(trial));
  const auto value = margin_for(trials_.back(), "");
  if (value && (!worst_ || *value < *trials_[*worst_].outcome.margin)) {
    worst_ = trials_.size() - 1;
  }
}

void FalsifySession::add(const FalsifySession& part) {
  for (const auto& trial : part.trials_) {
    take(trial);
  }
}

std::vector<BoxTrial> FalsifySession::samples_for(const SearchGoal& goal) const {
  std::vector<BoxTrial> samples;
  for (const auto& trial : trials_) {
    if (trial.space == goal.first && trial.sample) {
      samples.push_back(
          {.point = trial.point, .value = margin_for(trial, goal.second), .sample = trial.sample});
    }
  }
  return samples;
}

void FalsifySession::sample(std::size_t until, const std::vector<std::size_t>& order,
                            std::size_t& turn, const Measure& measure) {
  for (; trials_.size() < until && !over(); ++turn) {
    const auto space = order[turn % order.size()];
    const auto sample = samplers_[space].next();
    measure(space, {.point = sample.point, .sample = sample.kind});
  }
}

void FalsifySession::search(std::uint64_t round, const Measure& measure) {
  const auto first = trials_.size();
  const auto last = std::min(settings_.runs, first + settings_.runs_a_round * spaces_.size());
  const bool samples_alone = settings_.optimiser == Optimiser::kUniform;
  const auto sampled = samples_alone ? last : first + (last - first + 1) / 2;
  const std::uint64_t seed = settings_.seed + 1'000'003 * round;
  core::Random random(seed);
  const auto order = drawn_order(spaces_, random);
  std::size_t turn = 0;
  sample(sampled, order, turn, measure);
  const auto runs_of_one =
      std::max(kLeastRuns, (last - sampled) / ((spaces_.size() + kNearest - 1) / kNearest));
  for (const auto& goal : search_goals(std::span(trials_).subspan(first), spaces_)) {
    if (trials_.size() >= last || over()) {
      break;
    }
    const auto space = goal.first;
    const auto& rule = goal.second;
    auto found =
        search_box({.sides = spaces_[space].faults.sides(),
                    .runs = std::min(runs_of_one, last - trials_.size()),
                    .seed = seed + space,
                    .optimiser = settings_.optimiser,
                    .sampled_share = 0,
                    .stop_below = settings_.until_broken ? std::optional(0.0) : std::nullopt,
                    .known = samples_for(goal),
                    .begun = begun_[goal]},
                   [&](const BoxTrial& asked) {
                     measure(space, asked);
                     return margin_for(trials_.back(), rule);
                   });
    begun_[goal] = std::move(found.begun);
  }
  sample(last, order, turn, measure);
}

bool FalsifySession::run(const std::vector<Objective*>& objectives,
                         const std::function<bool()>& goes_on,
                         const std::function<void(const FalsifySession&)>& told) {
  const Measure measure = [&](std::size_t space, const BoxTrial& asked) {
    if (trials_.size() >= known_.size() && !goes_on()) {
      throw Interrupted();
    }
    take(measured(space, asked, *objectives.at(spaces_[space].experiment)));
    told(*this);
  };
  try {
    for (std::uint64_t round = 0; !over(); ++round) {
      search(round, measure);
    }
  } catch (const Interrupted&) {
    return false;
  }
  return true;
}

}  // namespace towbench::harness
