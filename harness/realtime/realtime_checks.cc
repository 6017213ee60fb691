#include "harness/realtime/realtime_checks.h"

#include <fmt/format.h>

namespace towbench::harness {
namespace {

// `worse`: what it is when the budget is exceeded.
Check jitter(std::string name, std::string meaning, const DurationFigures& figures,
             const TickSummary& side, core::Nanoseconds period_ns, Verdict worse) {
  Check check;
  check.name = std::move(name);
  check.meaning = std::move(meaning);
  check.source = "OR-BBMC-3c: execution jitter below 5 % of the control period";
  check.max = kMaxJitterShare;
  if (side.ticks == 0 || period_ns <= 0) {
    check.reason = "there was no tick";
    return check;
  }
  const double share =
      static_cast<double>(figures.p99_ns - figures.p50_ns) / static_cast<double>(period_ns);
  check.value = share;
  check.margin = (kMaxJitterShare - share) / kMaxJitterShare;
  check.verdict = share < kMaxJitterShare ? Verdict::kPass : worse;
  if (check.verdict != Verdict::kPass) {
    check.reason = fmt::format(
        "p99 is {:.1f} us above the median, {:.1f} % of the period; worst tick {}",
        static_cast<double>(figures.p99_ns - figures.p50_ns) * 1e-3, share * 100, figures.max_at);
  }
  return check;
}

}  // namespace

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
                                   core::Nanoseconds control_period_ns) {
  return {host_on_time(emulator), host_on_time(controller),
          jitter("control_lateness", "the host wakes the controller evenly", controller.lateness,
                 controller, control_period_ns, Verdict::kInvalid),
          jitter("control_jitter", "the controller's own work takes the same time in every tick",
                 controller.execution, controller, control_period_ns, Verdict::kFail)};
}

}  // namespace towbench::harness
