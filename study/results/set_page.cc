#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "study/results/identification_set.h"

namespace towbench::study {
namespace {

struct Pool {
  std::size_t estimates = 0;
  std::size_t covered = 0;
  std::size_t missed = 0;
  std::size_t wide = 0;
  double tolerance_pct = 0;
  double error_sum_pct = 0;
  double worst_pct = 0;
  double width_sum_pct = 0;

  void add(const Recovery& each) {
    ++estimates;
    covered += each.covered ? 1U : 0U;
    missed += each.agrees ? 0U : 1U;
    wide += each.narrow ? 0U : 1U;
    tolerance_pct = each.tolerance_pct;
    error_sum_pct += each.error_pct;
    worst_pct = std::max(worst_pct, std::fabs(each.error_pct));
    width_sum_pct += each.width_pct;
  }
};

std::string row_of(const std::string& name, const Pool& pool, bool whole) {
  const auto n = static_cast<double>(std::max<std::size_t>(1, pool.estimates));
  const auto demand = whole ? std::string("-") : fmt::format("{:.3g}", pool.tolerance_pct);
  const auto error = whole
                         ? std::string("- | -")
                         : fmt::format("{:+.2f} | {:.2f}", pool.error_sum_pct / n, pool.worst_pct);
  const auto width = whole ? std::string("-") : fmt::format("{:.2f}", pool.width_sum_pct / n);
  return fmt::format("| {} | {} | {} | {} | {:.1f} | {} | {} | {} |\n", name, pool.estimates,
                     demand, error, 100 * static_cast<double>(pool.covered) / n, width, pool.missed,
                     pool.wide);
}

}  // namespace

std::string set_page(const IdentificationSet& set, const std::vector<SetRun>& runs) {
  std::map<std::string, Pool> pools;
  Pool whole;
  std::map<std::string, std::size_t> reasons;
  std::size_t done = 0;
  for (const auto& run : runs) {
    done += run.done ? 1U : 0U;
    for (const auto& each : run.recoveries) {
      pools[each.estimate.quantity + ", " + each.estimate.axis].add(each);
      whole.add(each);
    }
    for (const auto& each : run.not_done) {
      ++reasons[fmt::format("machine {}: {}", run.machine, each)];
    }
  }
  std::string text = fmt::format(
      "# Identification of {} machines, {} seeds each\n\n"
      "Machine 0 is `{}`, the others have inertia, friction, drive constants and transmission "
      "drawn "
      "within "
      "+-{:.0f} %.\n{} of {} runs are done. Percentages are of the truth. Demand: value within p "
      "%, "
      "interval at most 4 p % wide, 92 to 98 % of\nat least 400 intervals hold the truth.\n\n"
      "| quantity, axis | estimates | p | mean error | worst | covered, % | mean width | off by "
      "more "
      "than p | too wide |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
      set.machines, set.seeds, set.rig.name, 100 * set.spread, done, runs.size());
  for (const auto& [name, pool] : pools) {
    text += row_of(name, pool, false);
  }
  text += row_of("all", whole, true);
  if (!reasons.empty()) {
    text += "\nNot done:\n";
    for (const auto& [reason, times] : reasons) {
      text += fmt::format("- {} ({} times)\n", reason, times);
    }
  }
  return text;
}

}  // namespace towbench::study
