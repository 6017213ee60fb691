#include "harness/falsify/falsify_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace towbench::harness {
namespace {

constexpr std::size_t kParts = 20;

std::string margin_text(const FalsifyTrial* trial, const std::string& unit) {
  return trial == nullptr
             ? "none"
             : fmt::format("{:.4g}{}{}", *trial->outcome.margin, unit.empty() ? "" : " ", unit);
}

std::string row_of(const FalsifySession& session, std::size_t space, const std::string& unit) {
  const auto found = coverage_of(session, space);
  std::string covered;
  const auto& variables = session.spaces()[space].variables();
  for (std::size_t i = 0; i < variables.size(); ++i) {
    covered +=
        fmt::format("{}{} {:.0f} %", i == 0 ? "" : ", ", variables[i].name, 100 * found.covered[i]);
  }
  const auto bound = found.uniform_broken > 0
                         ? fmt::format("{} of {} broke it", found.uniform_broken, found.uniform)
                         : fmt::format("{:.3g} %", 100 * rule_of_three(found.uniform));
  return fmt::format(
      "| {} | {} | {} | {} | {} | {} | {} | {} |\n", session.spaces()[space].name(), found.runs,
      found.fired, found.uniform, covered, margin_text(found.worst, unit), bound,
      found.worst == nullptr ? "" : fmt::format("`{}`", fmt::join(found.worst->faults, "`, `")));
}

}  // namespace

SpaceCoverage coverage_of(const FalsifySession& session, std::size_t space) {
  SpaceCoverage found;
  const auto variables = session.spaces()[space].variables().size();
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
                           const std::string& experiment) {
  const auto* worst = session.worst();
  auto text = fmt::format("# Worst case of {}\n\nAsked: `{}` ({}).\n\n", experiment, asked.text(),
                          asked.name());
  text += worst == nullptr
              ? std::string("No fault took effect with an occasion to judge: nothing was tried.\n")
              : fmt::format("Smallest margin: {} with `{}`: {}.\n",
                            margin_text(worst, asked.unit()), fmt::join(worst->faults, "`, `"),
                            worst->outcome.broken ? "broken, " + worst->outcome.reason : "kept");
  text +=
      "\n| faults | runs | took effect | uniform samples | covered of the range | smallest margin "
      "| may still break it | where |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (std::size_t space = 0; space < session.spaces().size(); ++space) {
    text += row_of(session, space, asked.unit());
  }
  return text +
         "\nNothing found is no proof. The last column but one is what uniform sampling gives: "
         "with 95 % confidence no larger share of that space breaks what is asked (1 - "
         "0.05^(1/n), the rule of three). A run whose fault took no effect, or that gave no "
         "occasion, counts as not tried.\n";
}

}  // namespace towbench::harness
