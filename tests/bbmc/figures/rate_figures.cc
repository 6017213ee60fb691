// docs/measurements/control-rate.md: which control rate which loop needs.
//
//   build/tests/bbmc/bbmc_figures rates > docs/measurements/control-rate.md
#include <array>
#include <string>

#include <fmt/core.h>

#include "tests/bbmc/figures/figures.h"
#include "tests/bbmc/support/rated_run.h"

namespace towbench::tests {
namespace {

constexpr std::array kRates_Hz{1.0,   2.0,   5.0,   10.0,  20.0,  25.0,   50.0,   100.0,
                               125.0, 200.0, 250.0, 400.0, 500.0, 1000.0, 2000.0, 5000.0};
constexpr std::array kLoops{1.0 / 64, 1.0 / 32, 1.0 / 16, 1.0 / 8, 0.25, 0.5, 1.0, 2.0};

std::string name_of_loop(double speed_ratio) {
  return speed_ratio < 1 ? fmt::format("1/{:.0f}", 1 / speed_ratio)
                         : fmt::format("{:.0f}", speed_ratio);
}

void print_head(const char* first) {
  std::string rule = "| ---: |";
  fmt::print("| {} |", first);
  for (const double loop : kLoops) {
    fmt::print(" {} |", name_of_loop(loop));
    rule += " ---: |";
  }
  fmt::print("\n{}\n", rule);
}

void print_gains() {
  print_head("times as fast as `bbmc-tuned`");
  const auto line = [](const char* name, double bbmc::PidGains::*gain) {
    fmt::print("| {} |", name);
    for (const double loop : kLoops) {
      fmt::print(" {:.2g} |", gains_for_loop(loop).*gain);
    }
    fmt::print("\n");
  };
  line("K_P, N m/rad", &bbmc::PidGains::proportional_Nm_per_rad);
  line("K_I, N m/(rad s)", &bbmc::PidGains::integral_Nm_per_rad_s);
  line("K_D, N m s/rad", &bbmc::PidGains::derivative_Nm_s_per_rad);
  fmt::print("| natural frequency of the rigid axis, Hz |");
  for (const double loop : kLoops) {
    fmt::print(" {:.2g} |", natural_frequency_Hz(gains_for_loop(loop)));
  }
  fmt::print("\n");
}

std::string cell_of(const RatedRun& run) {
  return run.follows() ? fmt::format("{:.3g} / {:.2g}", 1e3 * run.peak_m, 1e3 * run.steady_rms_m)
                       : fmt::format("{}", core::number_of(run.fault));
}

void print_table(double speed_m_per_s, bool model) {
  fmt::print("\n### {:.0f} mm/s, {}\n\n", 1e3 * speed_m_per_s,
             model ? "PID with the model's torque (feed-forward, friction)" : "PID");
  print_head("Hz");
  for (const double rate_Hz : kRates_Hz) {
    fmt::print("| {:.0f} |", rate_Hz);
    for (const double loop : kLoops) {
      const auto configuration = rated(rate_Hz, gains_for_loop(loop), model);
      fmt::print(" {} |", bbmc::inconsistency(configuration) == nullptr
                              ? cell_of(run_at_rate(configuration, speed_m_per_s))
                              : "refused");
    }
    fmt::print("\n");
  }
}

// The slowest rate from which on a loop is as good as at the fastest, over its natural frequency.
void print_needed() {
  fmt::print(
      "\n## What a loop needs\n\nThe slowest of these rates from which on the loop follows both "
      "speeds with at most twice the RMS that it has at\n5 kHz:\n\n");
  print_head("loop");
  std::string needed = "| rate, Hz |";
  std::string over = "| over its natural frequency |";
  for (const double loop : kLoops) {
    const double rate_Hz = slowest_rate_Hz(gains_for_loop(loop), kRates_Hz, {0.05, 0.4});
    const double natural_Hz = natural_frequency_Hz(gains_for_loop(loop));
    needed += rate_Hz > 0 ? fmt::format(" {:.0f} |", rate_Hz) : " none |";
    over += rate_Hz > 0 ? fmt::format(" {:.0f} |", rate_Hz / natural_Hz) : " - |";
  }
  fmt::print("{}\n{}\n", needed, over);
}

}  // namespace

void print_rates() {
  fmt::print(
      "# Control rate: what a stable loop needs\n\n`bbmc_figures rates` prints this page. Nominal "
      "machine, Y, lockstep. The gains of `bbmc-tuned` for a loop so many times as fast\non the "
      "same inertia: K_P by the square, K_I by the cube. A trapezoid of 0.8 s to speed, 3 s of it, "
      "0.8 s to rest.\n\nA cell: peak over the whole profile / RMS of the steady part in mm, motor "
      "side, between control ticks too. A number alone: the fault that\nended the run (303: faster "
      "than its place allows; 312: encoder not trusted; 350: further than 50 mm from the "
      "reference). Refused: K_D is\nabove what a sampled loop can bear, 2 J times the rate.\n\n"
      "The thesis asks for a timer from 1 Hz to 5 kHz (OR-BBMC-3b), 1 kHz of control (3a) and, "
      "for control to be practical, 100 Hz at\nleast: ten times the 10 Hz of its shortest "
      "mechanical time constant, 100 ms (ch. 4). So the rates below 100 Hz are settings of the\n"
      "timer, for open-loop pulses and slow loops, not rates at which it tracks. What must react "
      "fast does not wait for the tick at any rate:\nexperiments `kill-10hz`, `kill-1khz`.\n\n");
  print_gains();
  print_needed();
  const bbmc::Configuration defaults;
  const auto& y = defaults.axes[core::Axis::kY];
  const double least_Nm_per_rad =
      y.friction.breakaway_Nm / (defaults.safety.tracking_error_limit_m / y.metres_per_motor_rad());
  fmt::print(
      "\nSo a loop wants some twenty to thirty times its natural frequency, more where little "
      "friction damps it. `bbmc-tuned` is near its best from\n250 Hz on and swings below; "
      "100 Hz bear half as fast a loop, 10 Hz an eighth.\n\nSofter loops are not rescued by any "
      "rate: K_P has to break the axis away within the 50 mm of the tracking limit, which takes "
      "{:.2g} N m/rad\nat rest and more in motion. At 1 and 2 Hz every loop as stiff as that is "
      "unstable. With the model's torque the loop has less to do, and soft\ngains follow down to 5 "
      "Hz: that is the model's merit, not the loop's. Experiments: `trapezoid-10hz`, "
      "`trapezoid-100hz`.\n\n## Peak and RMS by rate\n",
      least_Nm_per_rad);
  for (const bool model : {false, true}) {
    for (const double speed_m_per_s : {0.05, 0.4}) {
      print_table(speed_m_per_s, model);
    }
  }
}

}  // namespace towbench::tests
