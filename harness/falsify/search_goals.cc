#include "harness/falsify/search_goals.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace towbench::harness {
namespace {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// A space, and its smallest margin, from the usual one down.
struct Near {
  std::size_t space = 0;
  double margin = 0;
  double usual = 0;

  [[nodiscard]] double below() const noexcept { return usual - margin; }
  // Half of the usual distance is used up.
  [[nodiscard]] bool is_nearer() const noexcept { return below() > std::fabs(usual) / 2; }
};

std::vector<Near> nearest(std::span<const FalsifyTrial> trials,
                          const std::vector<SearchSpace>& spaces, const std::string& rule) {
  std::map<std::size_t, double> best;                  // of each space
  std::map<std::size_t, std::vector<double>> margins;  // of each experiment
  for (const auto& trial : trials) {
    if (const auto margin = margin_for(trial, rule)) {
      const auto at = best.try_emplace(trial.space, *margin).first;
      at->second = std::min(at->second, *margin);
      margins[spaces[trial.space].experiment].push_back(*margin);
    }
  }
  std::map<std::size_t, double> usual;
  for (auto& [experiment, all] : margins) {
    usual[experiment] = rule.empty() ? 0 : median(std::move(all));
  }
  std::vector<Near> found;
  for (const auto& [space, margin] : best) {
    found.push_back({space, margin, usual.at(spaces[space].experiment)});
  }
  if (!rule.empty()) {
    std::erase_if(found, [](const Near& one) { return !one.is_nearer(); });
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Near& a, const Near& b) { return a.below() > b.below(); });
  return found;
}

std::set<std::string> rules_of(std::span<const FalsifyTrial> trials) {
  std::set<std::string> rules;
  for (const auto& trial : trials) {
    for (const auto& [rule, margin] : trial.outcome.rules) {
      rules.insert(rule);
    }
  }
  return rules.empty() ? std::set<std::string>{""} : rules;
}

}  // namespace

std::optional<double> margin_for(const FalsifyTrial& trial, const std::string& rule) {
  if (!trial.outcome.fired || rule.empty()) {
    return trial.outcome.fired ? trial.outcome.margin : std::nullopt;
  }
  const auto found = trial.outcome.rules.find(rule);
  return found == trial.outcome.rules.end() ? std::nullopt : std::optional(found->second);
}

std::vector<SearchGoal> search_goals(std::span<const FalsifyTrial> trials,
                                     const std::vector<SearchSpace>& spaces) {
  std::map<std::string, std::vector<Near>> by_rule;
  std::size_t most = 0;
  for (const auto& rule : rules_of(trials)) {
    by_rule[rule] = nearest(trials, spaces, rule);
    most = std::max(most, by_rule[rule].size());
  }
  std::vector<SearchGoal> goals;
  for (std::size_t i = 0; i < most; ++i) {
    for (const auto& [rule, near] : by_rule) {
      if (i < near.size()) {
        goals.emplace_back(near[i].space, rule);
      }
    }
  }
  return goals;
}

}  // namespace towbench::harness
