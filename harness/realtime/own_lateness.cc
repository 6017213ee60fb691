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

Finding lateness_finding(const TickSummary& summary) {
  const auto p99_ns = summary.lateness.p99_ns;
  const auto share_of = [&](core::Nanoseconds period_ns) {
    return static_cast<double>(p99_ns) / static_cast<double>(period_ns);
  };
  Finding finding;
  finding.subject = "lateness";
  finding.found = fmt::format(
      "at 10 kHz p50 {:.0f}, p99 {:.0f}, p99.9 {:.0f}, max {:.0f} us, {} of {} ticks overrun ({})",
      static_cast<double>(summary.lateness.p50_ns) * 1e-3, static_cast<double>(p99_ns) * 1e-3,
      static_cast<double>(summary.lateness.p999_ns) * 1e-3,
      static_cast<double>(summary.lateness.max_ns) * 1e-3, summary.overruns, summary.ticks,
      summary.rights);
  if (summary.ticks == 0) {
    finding.found = "not measured";
  } else if (share_of(core::kPlantTick_ns) < kMaxJitterShare && !summary.host_was_late) {
    finding.fit = Fitness::kGood;
    finding.found += ": fit for 10 kHz";
  } else if (share_of(core::kNanosecondsPerMillisecond) < kMaxJitterShare) {
    finding.fit = Fitness::kLimited;
    finding.found += ": fit for a controller at 1 kHz";
    finding.remedy = "an isolated processor and a PREEMPT_RT kernel for the emulator";
  } else {
    const double rate_Hz = kMaxJitterShare / (static_cast<double>(p99_ns) * 1e-9);
    finding.found += fmt::format(": fit for controllers up to {:.0f} Hz", rate_Hz);
    finding.remedy = "stop other load; runs by the wall clock will be INVALID above that rate";
  }
  return finding;
}

}  // namespace towbench::harness
