#include "harness/falsify/falsify_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

std::string row_of(const SearchSpace& space, const SpaceCoverage& found, const std::string& unit) {
  const auto bound = found.uniform_broken > 0
                         ? fmt::format("{} of {} broke it", found.uniform_broken, found.uniform)
                         : fmt::format("{:.3g} %", 100 * rule_of_three(found.uniform));
  const bool one_of_few = found.worst != nullptr && !found.worst->tried.faults.empty();
  return fmt::format(
      "| {} | {} | {} | {} | {} | {} | {} | {} |\n", space.name(), found.runs, found.fired,
      found.uniform, covered_text(space.faults.variables(), found.covered),
      found.worst == nullptr ? "none" : margin_text(*found.worst->outcome.margin, unit), bound,
      one_of_few ? words_of({.faults = found.worst->tried.faults}) : "");
}

// Those that were tried; where they are many, that of the smallest margin first.
constexpr std::size_t kFew = 40;
std::vector<std::pair<std::size_t, SpaceCoverage>> tried_spaces(const FalsifySession& session) {
  std::vector<std::pair<std::size_t, SpaceCoverage>> all;
  for (std::size_t space = 0; space < session.spaces().size(); ++space) {
    if (auto found = coverage_of(session, space); found.runs > 0) {
      all.emplace_back(space, std::move(found));
    }
  }
  if (all.size() > kFew) {
    const auto margin = [](const SpaceCoverage& found) {
      return found.worst != nullptr ? *found.worst->outcome.margin
                                    : std::numeric_limits<double>::infinity();
    };
    std::stable_sort(all.begin(), all.end(), [&](const auto& a, const auto& b) {
      return margin(a.second) < margin(b.second);
    });
  }
  return all;
}

std::string table_of(const FalsifySession& session, const std::string& unit) {
  std::string text =
      "\n| faults | runs | took effect | uniform samples | covered of the range | smallest margin "
      "| may still break it | where |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  const auto tried = tried_spaces(session);
  std::size_t shown = 0;
  for (const auto& [space, found] : tried) {
    const bool broken = found.worst != nullptr && found.worst->outcome.broken;
    if (shown < kFew || broken) {
      text += row_of(session.spaces()[space], found, unit);
      ++shown;
    }
  }
  if (shown < session.spaces().size()) {
    text += fmt::format(
        "\n{} rows more came no nearer (`spaces.csv`), and for {} the runs did not "
        "suffice.\n",
        tried.size() - shown, session.spaces().size() - tried.size());
  }
  return text;
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
    if (trial.sample == SampleKind::kUniform) {
      ++found.uniform;
      found.uniform_broken += trial.outcome.broken ? 1U : 0U;
    }
    if (trial.sample) {
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
  text += table_of(session, asked.unit());
  return text +
         "\nNothing found is no proof. The last column but one is what uniform sampling gives: "
         "with 95 % confidence no larger share of that space breaks what is asked (1 - "
         "0.05^(1/n), the rule of three). A run whose fault took no effect, or that gave no "
         "occasion, counts as not tried.\n";
}

std::string spaces_csv(const FalsifySession& session) {
  std::string text = "space,runs,took_effect,uniform,uniform_broken,smallest_margin,broken,where\n";
  for (const auto& [space, found] : tried_spaces(session)) {
    const auto* worst = found.worst;
    text += fmt::format(
        "{},{},{},{},{},{},{},{}\n", session.spaces()[space].name(), found.runs, found.fired,
        found.uniform, found.uniform_broken,
        worst == nullptr ? "" : fmt::format("{}", *worst->outcome.margin),
        worst != nullptr && worst->outcome.broken ? 1 : 0,
        worst == nullptr ? "" : fmt::format("{}", fmt::join(worst->tried.words(), "; ")));
  }
  return text;
}

}  // namespace towbench::harness
