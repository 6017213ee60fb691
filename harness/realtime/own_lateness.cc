#include "harness/realtime/own_lateness.h"

#include <memory>
#include <thread>

#include <fmt/format.h>

#include "harness/realtime/realtime_checks.h"
#include "harness/realtime/realtime_rights.h"

namespace towbench::harness {

TickSummary measure_own_lateness(core::Nanoseconds duration_ns) {
  constexpr int kPriority = 80;
  TickSummary summary;
  std::thread([&] {
    const auto rights = take_realtime_rights(kPriority, 0);
    HostTickClock clock;
    const TickPolicy policy;
    const auto loop = std::make_unique<TickLoop>(clock, policy);
    loop->start();
    for (core::Nanoseconds t = 0; t < duration_ns; t += policy.period_ns) {
      loop->wait();
    }
    loop->end_tick();
    summary = summarise("host", rights.text(), policy, loop->record());
  }).join();
  return summary;
}

Finding lateness_finding(const TickSummary& summary, const RealtimeBudget& budget) {
  const auto us = [](core::Nanoseconds duration_ns) {
    return static_cast<double>(duration_ns) * 1e-3;
  };
  const auto& late = summary.lateness;
  const auto keeps_budget_at = [&](core::Nanoseconds period_ns) {
    return jitter_ratio(late, period_ns) < budget.jitter_p999_max_ratio;
  };
  Finding finding;
  finding.subject = "lateness";
  if (summary.ticks < kFewestTicksOfJitter) {
    finding.found = "not measured";
    return finding;
  }
  finding.found = fmt::format(
      "at 10 kHz p50 {:.0f}, p99 {:.0f}, p99.9 {:.0f}, max {:.0f} us, {} of {} ticks overrun ({})",
      us(late.p50_ns), us(late.p99_ns), us(late.p999_ns), us(late.max_ns), summary.overruns,
      summary.ticks, summary.rights);
  if (keeps_budget_at(core::kPlantTick_ns) && !summary.host_was_late) {
    finding.fit = Fitness::kGood;
    finding.found += ": fit for 10 kHz";
  } else if (keeps_budget_at(core::kNanosecondsPerMillisecond)) {
    finding.fit = Fitness::kLimited;
    finding.found += ": fit for a controller at 1 kHz";
    finding.remedy = "an isolated processor and a PREEMPT_RT kernel for the emulator";
  } else {
    const double rate_Hz = budget.jitter_p999_max_ratio / core::seconds(late.p999_ns - late.p50_ns);
    finding.found += fmt::format(": fit for controllers up to {:.0f} Hz", rate_Hz);
    finding.remedy = "stop other load; runs by the wall clock will be INVALID above that rate";
  }
  return finding;
}

}  // namespace towbench::harness
