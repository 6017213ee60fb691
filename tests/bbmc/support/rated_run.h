// A trapezoid on Y at a control rate, tracked between control ticks too: what a rate allows a loop.
#pragma once

#include <initializer_list>
#include <span>

#include "bbmc/system/configuration.h"
#include "core/error.h"

namespace towbench::tests {

struct RatedRun {
  bool ended = false;  // within a minute
  core::ErrorCode fault = core::ErrorCode::kNone;
  // Motor side against the profile, at every exchange.
  double peak_m = 0;        // whole profile
  double steady_rms_m = 0;  // from 1 s after the ramp to the end of the steady part

  [[nodiscard]] bool follows() const noexcept { return ended && fault == core::ErrorCode::kNone; }
};

// The gains of fixtures/controllers/bbmc-tuned.toml for a loop `speed_ratio` times as fast on the
// same inertia: K_P by its square, K_D by itself, K_I by its cube.
[[nodiscard]] bbmc::PidGains gains_for_loop(double speed_ratio);

// Plain PID of `gains` on Y at `rate_Hz`, nominal machine; with `model` the feed-forward of its
// friction and inertia too. 0.8 s to speed, 3 s of it, 0.8 s to rest. Precondition: the
// configuration is consistent at that rate.
[[nodiscard]] bbmc::Configuration rated(double rate_Hz, const bbmc::PidGains& gains, bool model);
[[nodiscard]] RatedRun run_at_rate(const bbmc::Configuration& configuration, double speed_m_per_s);

// sqrt(K_P / J) / 2 pi of Y's rigid axis.
[[nodiscard]] double natural_frequency_Hz(const bbmc::PidGains& gains);
// The first of `rates_Hz`, which rise, from which on to the last plain PID follows every speed with
// at most twice the RMS that it has at the last. 0: none.
[[nodiscard]] double slowest_rate_Hz(const bbmc::PidGains& gains, std::span<const double> rates_Hz,
                                     std::initializer_list<double> speeds_m_per_s);

}  // namespace towbench::tests
