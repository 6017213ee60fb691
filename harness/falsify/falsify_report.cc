#include "harness/falsify/falsify_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace towbench::harness {
namespace {

constexpr std::size_t kParts = 20;

// What has no other words is the experiment as its files say.
std::string words_of(const SearchCase& one) {
  const auto words = one.words();
  return words.empty() ? "the experiment as it is" : fmt::format("`{}`", fmt::join(words, "`, `"));
}

std::string margin_text(double margin, const std::string& unit) {
  return fmt::format("{:.4g}{}{}", margin + 0.0, unit.empty() ? "" : " ", unit);  // no -0
}

// Each variable, or the least covered of many.
std::string covered_text(const std::vector<SearchVariable>& variables,
                         const std::vector<double>& covered) {
  constexpr std::size_t kMany = 5;
  if (variables.size() > kMany) {
    const auto least = std::min_element(covered.begin(), covered.end()) - covered.begin();
    return fmt::format("{} variables, least {} {:.0f} %", variables.size(),
                       variables[static_cast<std::size_t>(least)].name,
                       100 * covered[static_cast<std::size_t>(least)]);
  }
  std::string text;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    text += fmt::format("{}{} {:.0f} %", i == 0 ? "" : ", ", variables[i].name, 100 * covered[i]);
  }
  return text;
}

std::string row_of(const FalsifySession& session, std::size_t space, const std::string& unit) {
  const auto found = coverage_of(session, space);
  const auto& of = session.spaces()[space];
  if (found.runs == 0) {
    return {};
  }
  const auto bound = found.uniform_broken > 0
                         ? fmt::format("{} of {} broke it", found.uniform_broken, found.uniform)
                         : fmt::format("{:.3g} %", 100 * rule_of_three(found.uniform));
  const bool one_of_few = found.worst != nullptr && !found.worst->tried.faults.empty();
  return fmt::format(
      "| {} | {} | {} | {} | {} | {} | {} | {} |\n", of.name(), found.runs, found.fired,
      found.uniform, covered_text(of.faults.variables(), found.covered),
      found.worst == nullptr ? "none" : margin_text(*found.worst->outcome.margin, unit), bound,
      one_of_few ? words_of({.faults = found.worst->tried.faults}) : "");
}

}  // namespace

SpaceCoverage coverage_of(const FalsifySession& session, std::size_t space) {
  SpaceCoverage found;
  const auto variables = session.spaces()[space].faults.variables().size();
  std::vector<std::vector<bool>> parts(variables, std::vector<bool>(kParts));
  for (const auto& trial : session.trials()) {
    if (trial.space != space) {
      continue;
    }
    ++found.runs;
    found.fired += trial.outcome.fired ? 1U : 0U;
    if (!trial.outcome.fired || !trial.outcome.margin) {
      continue;
    }
    if (found.worst == nullptr || *trial.outcome.margin < *found.worst->outcome.margin) {
      found.worst = &trial;
    }
    if (trial.uniform) {
      ++found.uniform;
      found.uniform_broken += trial.outcome.broken ? 1U : 0U;
      for (std::size_t i = 0; i < variables; ++i) {
        parts[i][std::min(kParts - 1, static_cast<std::size_t>(trial.point[i] * kParts))] = true;
      }
    }
  }
  for (const auto& of_variable : parts) {
    found.covered.push_back(
        static_cast<double>(std::count(of_variable.begin(), of_variable.end(), true)) / kParts);
  }
  return found;
}

double rule_of_three(std::size_t samples) noexcept {
  return samples == 0 ? 1 : 1 - std::pow(0.05, 1 / static_cast<double>(samples));
}

std::string falsify_report(const FalsifySession& session, const Asked& asked,
                           const std::string& experiment, const ShrunkCase* needed) {
  const auto* worst = session.worst();
  auto text = fmt::format("# Worst case of {}\n\nAsked: `{}` ({}).\n\n", experiment, asked.text(),
                          asked.name());
  text +=
      worst == nullptr
          ? std::string("No fault took effect with an occasion to judge: nothing was tried.\n")
          : fmt::format("Smallest margin: {} with {}: {}.\n",
                        margin_text(*worst->outcome.margin, asked.unit()), words_of(worst->tried),
                        worst->outcome.broken ? "broken, " + worst->outcome.reason : "kept");
  if (needed != nullptr) {
    text +=
        fmt::format("Needed of it, by {} further runs: {}, margin {}.\n", needed->runs,
                    words_of(needed->needed), margin_text(*needed->outcome.margin, asked.unit()));
  }
  text +=
      "\n| faults | runs | took effect | uniform samples | covered of the range | smallest margin "
      "| may still break it | where |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  std::size_t untried = 0;
  for (std::size_t space = 0; space < session.spaces().size(); ++space) {
    const auto row = row_of(session, space, asked.unit());
    untried += row.empty() ? 1U : 0U;
    text += row;
  }
  if (untried > 0) {
    text += fmt::format("\n{} of {} rows are left out: the runs did not suffice for one each.\n",
                        untried, session.spaces().size());
  }
  return text +
         "\nNothing found is no proof. The last column but one is what uniform sampling gives: "
         "with 95 % confidence no larger share of that space breaks what is asked (1 - "
         "0.05^(1/n), the rule of three). A run whose fault took no effect, or that gave no "
         "occasion, counts as not tried.\n";
}

}  // namespace towbench::harness
