#include "study/results/own_gains_tables.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string_view>

#include <fmt/format.h>

#include "study/results/thesis_tracking.h"
#include "study/statistics/statistics.h"

namespace towbench::study {
namespace {

constexpr double kBreakaway_Nm = 3.7e-3;  // (7.2)

std::string head(std::string first, const std::vector<OwnGains>& all) {
  std::string rule = "\n| --- |";
  for (const auto& own : all) {
    first += fmt::format(" | `{}`", own.controller);
    rule += " --- |";
  }
  return "| " + first + " |" + rule;
}

std::string row(const std::string& first, const std::vector<OwnGains>& all,
                const std::function<std::string(const OwnGains&)>& cell) {
  std::string text = "| " + first + " |";
  for (const auto& own : all) {
    text += " " + cell(own) + " |";
  }
  return text + "\n";
}

std::string gains(const std::vector<OwnGains>& all) {
  std::string text =
      "\n## Table 7.2: the thesis's own gains\n\n"
      "Tables 7.6 and 8.3 were measured with the gains of Table 7.2 (7.2.2, 8.2.3), or with others "
      "of the same program:\n`bbmc-0.5` has its defaults. Motor counts of 2 pi / 4000 rad (3.43), "
      "1 % duty by (7.3) and Table 7.1, samples of 1 ms (firmware).\n\n";
  text += head("Y", all) + "\n";
  const auto line = [&](const char* words, double OwnGains::*gain) {
    text += row(words, all, [&](const OwnGains& own) { return fmt::format("{:.3g}", own.*gain); });
  };
  line("K_P, N m a count", &OwnGains::proportional_Nm_per_count);
  line("K_I, N m a count and second", &OwnGains::integral_Nm_per_count_s);
  line("K_D, N m s a count", &OwnGains::derivative_Nm_s_per_count);
  text += row("K_I/K_P, 1/s", all,
              [](const OwnGains& own) { return fmt::format("{:.3g}", own.integral_rate_per_s()); });
  text += row("error at which K_P alone breaks away, mm", all, [](const OwnGains& own) {
    return fmt::format("{:.3g}",
                       1e3 * own.m_per_count * kBreakaway_Nm / own.proportional_Nm_per_count);
  });
  return text;
}

std::string error_in_mm(const TrackedRun& run, double TrackedRun::*error) {
  return run.trouble.empty() ? fmt::format("{:.3g}", 1e3 * run.*error) : run.trouble;
}

std::string slow(const std::vector<OwnGains>& all, std::string_view title,
                 std::vector<TrackedSpeed> OwnGains::*runs) {
  std::string text = fmt::format("\n{}\n\n", title);
  text += head("mm/s | thesis, print", all) + " --- |\n";
  for (std::size_t k = 0; k < kTable7_6.size(); ++k) {
    text += row(
        fmt::format("{:.0f} | {:.3g}", kTable7_6[k].speed_mm_per_s, kTable7_6[k].position_error_mm),
        all, [&](const OwnGains& own) {
          return error_in_mm((own.*runs).at(k).run, &TrackedRun::mean_m);
        });
  }
  return text;
}

std::string fast(const std::vector<OwnGains>& all) {
  std::string text =
      "\nTable 8.3, mean of the absolute position error over the whole profile, motor side, in "
      "air, mm:\n\n";
  text += head("mm/s | thesis", all) + " --- |\n";
  for (std::size_t k = 0; k < kTable8_3.size(); ++k) {
    text += row(
        fmt::format("{:.0f} | {:.3g}", kTable8_3[k].speed_mm_per_s, kTable8_3[k].position_error_mm),
        all, [&](const OwnGains& own) {
          return error_in_mm(own.fast.at(k).run, &TrackedRun::whole_mean_m);
        });
  }
  return text;
}

// Print over bench, without its sign: which unit makes it 1.
std::string print_over_bench(const std::vector<TrackedSpeed>& runs, double m_per_print) {
  std::vector<double> ratios;
  for (std::size_t k = 0; k < kTable7_6.size() && k < runs.size(); ++k) {
    if (runs[k].run.trouble.empty()) {
      ratios.push_back(
          std::fabs(m_per_print * kTable7_6[k].position_error_mm / runs[k].run.mean_m));
    }
  }
  if (ratios.empty()) {
    return "-";
  }
  const auto [low, high] = std::minmax_element(ratios.begin(), ratios.end());
  return fmt::format("{:.2g} ({:.2g} .. {:.2g})", statistics::median(ratios), *low, *high);
}

// By (4.12) at steady speed and friction: K_P e' + K_I e = 0, whatever the unit of length.
std::string thesis_rate() {
  std::vector<double> rates;
  for (const auto& each : kTable7_6) {
    rates.push_back(-each.velocity_error_mm_per_s / each.position_error_mm);
  }
  return fmt::format("{:.2f}", statistics::median(rates));
}

std::string bench_rate(const OwnGains& own) {
  std::vector<double> rates;
  for (const auto& each : own.early) {
    rates.push_back(-each.run.speed_mean_m_per_s / each.run.mean_m);
  }
  return fmt::format("{:.2f}", statistics::median(rates));
}

constexpr std::string_view kReading =
    "\nThe bench supports metres, from windows of a few seconds. With the thesis's gains the "
    "steady "
    "error is friction over K_P,\nless what an integral of 4 s has taken: millimetres. Read in mm, "
    "the print is hundreds to thousands of times below that.\n\n"
    "- At steady speed (4.12) leaves K_P de/dt + K_I e = 0, so velocity over position error is "
    "K_I/K_P in any unit of length:\n  the last row. The median of Table 7.6 obeys it with the "
    "gains per count and sample, and Table 7.2's K_I/K_P is then\n  BBMC 0.5's.\n"
    "- Table 8.3, same gains (8.2.3), prints 1.8 and 1.9 mm at 350 and 450 mm/s; Table 7.6 prints "
    "1.645e-3 at 400.\n"
    "- 7.3.1 concludes \"even sub-millimeter accuracy\" and less than 1 mm/s, 8.2.3 \"millimeter "
    "accuracy\".\n\n"
    "What does not fit: the print hardly depends on speed, the bench's error does, and over the "
    "whole track it falls with the\ntime spent. Half a count is 1.12 um, near the print in mm. In "
    "size, the print lies between the two sets of gains: which\nof them was used in which table, "
    "the thesis does not settle.\n";

std::string reading(const std::vector<OwnGains>& all) {
  std::string text =
      "\nThe unit of Table 7.6. Print over bench, median of 14 speeds (smallest .. largest):\n\n";
  text += head("reading", all) + "\n";
  const auto line = [&](const char* words, std::vector<TrackedSpeed> OwnGains::*runs, double unit) {
    text += row(words, all, [&](const OwnGains& own) { return print_over_bench(own.*runs, unit); });
  };
  line("metres, early", &OwnGains::early, 1);
  line("metres, whole track", &OwnGains::whole, 1);
  line("mm, early", &OwnGains::early, 1e-3);
  line("mm, whole track", &OwnGains::whole, 1e-3);
  text += row(fmt::format("velocity over position error, 1/s: thesis {}", thesis_rate()), all,
              bench_rate);
  text += kReading;
  return text;
}

std::string circle(const std::vector<OwnGains>& all) {
  std::string text =
      "\nCircle of Figs 7.14, 7.15: 0.2 m, 7 s, motor side. The copy of the thesis has no scale of "
      "these figures. 7.3.2 says\nthat the error is largest at the peaks of position, where an "
      "axis reverses, and that Y is above X. X has BBMC 0.5's\ngains in the first two columns.\n\n";
  text += head("quantity", all) + "\n";
  const auto line = [&](const char* words, core::Axis axis, double CircleError::*of, double unit) {
    text += row(words, all, [&](const OwnGains& own) {
      return own.circle.trouble.empty() ? fmt::format("{:.3g}", unit * own.circle.axes[axis].*of)
                                        : own.circle.trouble;
    });
  };
  line("Y, peak, mm", core::Axis::kY, &CircleError::peak_m, 1e3);
  line("Y, RMS, mm", core::Axis::kY, &CircleError::rms_m, 1e3);
  line("Y, speed at the peak, % of the largest", core::Axis::kY, &CircleError::speed_share_at_peak,
       100);
  line("X, peak, mm", core::Axis::kX, &CircleError::peak_m, 1e3);
  line("X, RMS, mm", core::Axis::kX, &CircleError::rms_m, 1e3);
  line("X, speed at the peak, % of the largest", core::Axis::kX, &CircleError::speed_share_at_peak,
       100);
  text +=
      "\nY is above X with each set. The peak is at a reversal, at a small speed, on X and with "
      "the tuned gains; Y with softer gains\nlags most where it is fast.\n";
  return text;
}

}  // namespace

std::string own_gains_tables(const std::vector<OwnGains>& all) {
  std::string text = gains(all);
  text += slow(all,
               "Table 7.6, mean position error of steady speed, motor side, mm. Early: 1 s to 3 s "
               "after the ramp:",
               &OwnGains::early);
  text += slow(all, "The same over the whole track, or as long as BBMC 0.5's log of 131 s:",
               &OwnGains::whole);
  text += fast(all);
  text += reading(all);
  text += circle(all);
  return text;
}

}  // namespace towbench::study
