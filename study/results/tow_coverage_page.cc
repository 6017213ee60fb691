#include <algorithm>
#include <cmath>
#include <map>

#include <boost/math/distributions/binomial.hpp>
#include <fmt/format.h>

#include "study/results/tow_set.h"

namespace towbench::study {
namespace {

std::string name_of(const identify::Estimate& estimate) {
  return estimate.axis.empty() ? estimate.quantity : estimate.quantity + ", " + estimate.axis;
}

void add(const Recovery& each, TowCoverage& to) {
  ++to.intervals;
  to.covered += each.covered ? 1U : 0U;
  const auto n = static_cast<double>(to.intervals);
  to.mean_error_pct += (each.error_pct - to.mean_error_pct) / n;
  to.mean_width_pct += (each.width_pct - to.mean_width_pct) / n;
  to.worst_error_pct = std::max(to.worst_error_pct, std::fabs(each.error_pct));
  to.withheld = each.estimate.no_interval;
}

constexpr double kLeast = 0.90;
constexpr double kMost = 0.99;

const char* word_of(TowCoverage::Verdict verdict) {
  switch (verdict) {
    case TowCoverage::Verdict::kHeld:
      return "yes";
    case TowCoverage::Verdict::kLikely:
      return "NO, within chance";
    case TowCoverage::Verdict::kNot:
      break;
  }
  return "NO";
}

std::string row_of(const TowCoverage& c) {
  const auto errors = fmt::format("{:+.3f} | {:.3f}", c.mean_error_pct, c.worst_error_pct);
  if (!c.withheld.empty()) {
    return fmt::format("| {} | {} | - | - | {} | - | withheld: {} |\n", c.quantity, c.intervals,
                       errors, c.withheld);
  }
  const auto [low, high] = c.range();
  return fmt::format("| {} | {} | {:.1f} | {:.0f} .. {:.0f} | {} | {:.3f} | {} |\n", c.quantity,
                     c.intervals, 100 * c.share(), 100 * low, 100 * high, errors, c.mean_width_pct,
                     word_of(c.verdict()));
}

}  // namespace

std::pair<double, double> TowCoverage::range() const {
  using Binomial = boost::math::binomial_distribution<double>;
  const auto n = static_cast<double>(intervals);
  const auto k = static_cast<double>(covered);
  constexpr double kTail = 0.025;
  return {Binomial::find_lower_bound_on_p(n, k, kTail),
          Binomial::find_upper_bound_on_p(n, k, kTail)};
}

TowCoverage::Verdict TowCoverage::verdict() const {
  if (share() >= kLeast && share() <= kMost) {
    return Verdict::kHeld;
  }
  const auto [low, high] = range();
  // Of fewer, nearly every share is likely.
  constexpr std::size_t kFewest = 40;
  return intervals >= kFewest && high >= kLeast && low <= kMost ? Verdict::kLikely : Verdict::kNot;
}

std::vector<TowCoverage> coverage_of(const std::vector<TowSetRun>& runs) {
  std::vector<TowCoverage> found;
  for (const auto& run : runs) {
    for (const auto& each : run.recoveries) {
      const auto name = name_of(each.estimate);
      auto at = std::find_if(found.begin(), found.end(),
                             [&](const TowCoverage& c) { return c.quantity == name; });
      if (at == found.end()) {
        at = found.insert(found.end(), {.quantity = name});
      }
      add(each, *at);
    }
  }
  return found;
}

std::string tow_coverage_page(const TowSet& set, const std::vector<TowSetRun>& runs) {
  std::map<std::string, std::size_t> reasons;
  std::size_t done = 0;
  for (const auto& run : runs) {
    done += run.done ? 1U : 0U;
    for (const auto& each : run.not_done) {
      ++reasons[fmt::format("machine {}: {}", run.machine, each)];
    }
  }
  std::string text = fmt::format(
      "# Coverage of the tow experiments' intervals\n\n"
      "{} machines, {} seeds each: {} of {} runs are done. Machine 0 is `{}`, the others have "
      "other friction, inertia, motor and transmission.\n"
      "Each quantity is pooled over machines, seeds and the places of its map. Percentages of "
      "errors and widths are of the truth. Demand: 90 to 99 % of\n"
      "the 95 % intervals hold the truth; range: where the true share is likely to be (Clopper and "
      "Pearson, 95 %, as if the intervals were independent).\n"
      "NO, within chance: the share lies outside the demand and its range does not; of 40 sound "
      "intervals all hold the truth every eighth time.\n"
      "`./towbench tow --drawn {} --seeds {}` writes this page.\n\n"
      "| quantity, axis | intervals | covered, % | range, % | mean error, % | worst, % | mean "
      "width, % | held |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n",
      set.machines, set.seeds, done, runs.size(), set.rig.name, set.machines, set.seeds);
  for (const auto& each : coverage_of(runs)) {
    text += row_of(each);
  }
  if (!reasons.empty()) {
    text += "\nNot done:\n";
    for (const auto& [reason, times] : reasons) {
      text += fmt::format("- {} ({} times)\n", reason, times);
    }
  }
  return text;
}

}  // namespace towbench::study
