#include "harness/realtime/realtime_checks.h"

#include <utility>

#include <fmt/format.h>

namespace towbench::harness {
namespace {

// `worse`: what it is when the budget is exceeded.
Check jitter(std::string name, std::string meaning, const DurationFigures& figures,
             const TickSummary& side, core::Nanoseconds period_ns, const RealtimeBudget& budget,
             Verdict worse) {
  Check check;
  check.name = std::move(name);
  check.meaning = std::move(meaning);
  check.source = budget.source;
  check.max = budget.jitter_p999_max_ratio;
  if (side.ticks < kFewestTicksOfJitter || period_ns <= 0) {
    check.reason = side.ticks == 0 ? "there was no tick"
                                   : fmt::format("{} ticks are too few for p99.9, {} are needed",
                                                 side.ticks, kFewestTicksOfJitter);
    return check;
  }
  const double ratio = jitter_ratio(figures, period_ns);
  check.value = ratio;
  check.margin = (budget.jitter_p999_max_ratio - ratio) / budget.jitter_p999_max_ratio;
  check.verdict = ratio < budget.jitter_p999_max_ratio ? Verdict::kPass : worse;
  if (check.verdict != Verdict::kPass) {
    check.reason = fmt::format(
        "p99.9 is {:.1f} us above the median, {:.1f} % of the period; worst tick {}",
        static_cast<double>(figures.p999_ns - figures.p50_ns) * 1e-3, ratio * 100, figures.max_at);
  }
  return check;
}

}  // namespace

double jitter_ratio(const DurationFigures& figures, core::Nanoseconds period_ns) {
  return static_cast<double>(figures.p999_ns - figures.p50_ns) / static_cast<double>(period_ns);
}

Check host_on_time(const TickSummary& side) {
  Check check;
  check.name = side.side + "_host_on_time";
  check.meaning = "the host ran every tick, none later than may be caught up";
  check.value = static_cast<double>(side.most_behind);
  check.unit = "ticks";
  check.max = side.max_behind;
  check.verdict = Verdict::kPass;
  if (side.ticks == 0) {
    check.verdict = Verdict::kInvalid;
    check.reason = "there was no tick";
  } else if (side.host_was_late) {
    check.verdict = Verdict::kInvalid;
    check.reason = fmt::format(
        "the host was late: tick {} began {} ticks of {} us after it was due", side.worst_tick,
        side.most_behind, side.period_ns / core::kNanosecondsPerMicrosecond);
  }
  return check;
}

std::vector<Check> realtime_checks(const TickSummary& emulator, const TickSummary& controller,
                                   core::Nanoseconds control_period_ns,
                                   const RealtimeBudget& budget) {
  auto lateness =
      jitter("control_lateness", "the host wakes the controller evenly", controller.lateness,
             controller, control_period_ns, budget, Verdict::kInvalid);
  // A host that does not wake both sides evenly interrupts their work too: whose it was, is
  // unknown.
  const bool host_is_even =
      lateness.verdict == Verdict::kPass &&
      jitter_ratio(emulator.lateness, control_period_ns) < budget.jitter_p999_max_ratio;
  const auto worse = host_is_even ? Verdict::kFail : Verdict::kInvalid;
  auto work =
      jitter("control_jitter", "the controller's own work takes the same time in every tick",
             controller.execution, controller, control_period_ns, budget, worse);
  return {host_on_time(emulator), host_on_time(controller), std::move(lateness), std::move(work)};
}

}  // namespace towbench::harness
