#include "harness/falsify/falsify_session.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "harness/campaign/results_file.h"

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
              {"uniform", trial.uniform},
              {"tried", trial.tried.words()},
              {"fired", trial.outcome.fired},
              {"margin", trial.outcome.margin ? json(*trial.outcome.margin) : json(nullptr)},
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
  Outcome outcome{
      .fired = line.at("fired"), .broken = line.at("broken"), .reason = line.at("reason")};
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

}  // namespace

FalsifySession::FalsifySession(FalsifySettings settings, std::vector<FaultSpace> spaces,
                               const std::filesystem::path& file)
    : settings_(std::move(settings)),
      spaces_(std::move(spaces)),
      file_(file),
      known_(lines_of(file, settings_.fingerprint)) {}

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
                     .uniform = asked.uniform,
                     .tried = spaces_[space].case_at(asked.point)};
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

bool FalsifySession::run(Objective& objective, const std::function<bool()>& goes_on,
                         const std::function<void(const FalsifySession&)>& told) {
  for (std::uint64_t round = 0; !over(); ++round) {
    for (std::size_t space = 0; space < spaces_.size() && !over(); ++space) {
      const BoxSearchSettings settings{
          .variables = spaces_[space].variables().size(),
          .runs = std::min(settings_.runs_a_round, settings_.runs - trials_.size()),
          .seed = settings_.seed + 1'000'003 * round + space,
          .optimiser = settings_.optimiser,
          .stop_below = settings_.until_broken ? std::optional(0.0) : std::nullopt};
      try {
        (void)search_box(settings, [&](const BoxTrial& asked) {
          if (trials_.size() >= known_.size() && !goes_on()) {
            throw Interrupted();
          }
          trials_.push_back(measured(space, asked, objective));
          const auto& outcome = trials_.back().outcome;
          const auto value = outcome.fired ? outcome.margin : std::nullopt;
          if (value && (!worst_ || *value < *trials_[*worst_].outcome.margin)) {
            worst_ = trials_.size() - 1;
          }
          told(*this);
          return value;
        });
      } catch (const Interrupted&) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace towbench::harness
