#include "harness/panel/live_estimators.h"

#include <cstdlib>

namespace towbench::harness {

LiveEstimators::OfAxis LiveEstimators::of_axis(const bbmc::AxisConfiguration& axis,
                                               double control_rate_Hz) noexcept {
  const auto by = [&](bbmc::VelocityMethod method) {
    auto settings = axis.velocity;
    settings.method = method;
    return bbmc::VelocityEstimator(settings, control_rate_Hz);
  };
  return {.by = {by(bbmc::VelocityMethod::kFrequency), by(bbmc::VelocityMethod::kPeriod),
                 by(bbmc::VelocityMethod::kHybrid)},
          .m_per_count = axis.m_per_count(),
          .capture_clock_Hz = axis.velocity.capture_clock_Hz};
}

LiveEstimators::LiveEstimators(const ShownMachine& machine) {
  for (const auto which : machine.shown) {
    axes_.emplace_back(which, of_axis(machine.axes[which], machine.control_rate_Hz));
  }
}

LiveEstimators::Speeds LiveEstimators::update(const LiveRow& row) noexcept {
  Speeds speeds;
  for (auto& [which, axis] : axes_) {
    const auto now = row.axis(which);
    // A count that moved further than there were edges has been declared anew, not driven there.
    const auto count = now.count;
    const auto change = count - axis.last_count;
    if (axis.started && std::llabs(change) > static_cast<long long>(now.edges)) {
      axis.declared += change;
    }
    axis.started = true;
    axis.last_count = count;
    const auto reading = registers_of(now.last_edges, row.time_ns, axis.capture_clock_Hz);
    for (std::size_t method = 0; method < kMethods; ++method) {
      speeds[which][method] =
          axis.by[method].update(reading, count - axis.declared) * axis.m_per_count;
    }
  }
  return speeds;
}

}  // namespace towbench::harness
