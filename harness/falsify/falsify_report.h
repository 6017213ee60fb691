// What a search covered and what that is worth, in Markdown.
#pragma once

#include <string>

#include "harness/falsify/falsify_session.h"
#include "harness/falsify/shrink_case.h"

namespace towbench::harness {

struct SpaceCoverage {
  std::size_t runs = 0;
  std::size_t fired = 0;
  std::size_t uniform = 0;         // that fired and gave a margin
  std::size_t uniform_broken = 0;  // of those
  const FalsifyTrial* worst = nullptr;
  // Of each variable the share of twenty equal parts of its range with a sample of any kind that
  // fired and gave a margin.
  std::vector<double> covered{};
};
[[nodiscard]] SpaceCoverage coverage_of(const FalsifySession& session, std::size_t space);

// With 95 % confidence no larger share of the space breaks what is asked, when `samples` uniform
// ones did not: 1 - 0.05^(1/n), about 3/n (Hanley and Lippman-Hand, JAMA 249, 1983). 1 for none.
[[nodiscard]] double rule_of_three(std::size_t samples) noexcept;

// `needed`: what of the worst case it takes; null when nothing was tried.
[[nodiscard]] std::string falsify_report(const FalsifySession& session, const Asked& asked,
                                         const std::string& experiment, const ShrunkCase* needed);

// Every space that was tried, as comma-separated values.
[[nodiscard]] std::string spaces_csv(const FalsifySession& session);

}  // namespace towbench::harness
