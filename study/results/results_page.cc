#include "study/results/results_page.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "study/results/identification_tables.h"
#include "study/results/own_gains_tables.h"
#include "study/results/thesis_tracking.h"

namespace towbench::study {
namespace {

std::string tracking(const Results& results) {
  std::string text =
      "\n## Table 7.6: trapezoids on Y, plain PID\n\n"
      "um. Motor side: steady state, peak of the whole profile. Truth: the carriage behind the "
      "elastic transmission.\n\n"
      "| mm/s | thesis, mean | bench, mean | RMS | peak | truth, carriage peak |\n"
      "| --- | --- | --- | --- | --- | --- |\n";
  for (std::size_t k = 0; k < results.slow.size(); ++k) {
    const auto& [speed, run] = results.slow[k];
    text += fmt::format("| {:.0f} | {:.2f} | {:.2f} | {:.1f} | {:.0f} | {:.0f} |{}\n", 1e3 * speed,
                        1e3 * kTable7_6.at(k).position_error_mm, 1e6 * run.mean_m, 1e6 * run.rms_m,
                        1e6 * run.peak_m, 1e6 * run.carriage_peak_m,
                        run.trouble.empty() ? "" : " " + run.trouble);
  }
  text +=
      "\nThe column of the thesis is read in mm as printed; the gains here are not the thesis's, "
      "and with its own the\nunit is metres: see below. A signed mean alone says nothing of how "
      "well a reference is followed, so RMS and peak\nstand beside it. Every law: "
      "`docs/measurements/tracking.md`.\n";
  return text;
}

std::string fast_tracking(const Results& results) {
  std::string text =
      "\n## Table 8.3: fast trapezoids, with and without the object in the water\n\n"
      "mm, whole profile, plain PID. Demand: peak below the thesis's mean.\n\n"
      "| mm/s | thesis, mean | bench, peak in air | in water | truth, carriage mean in water | "
      "carriage peak | demand |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (std::size_t k = 0; k < results.fast_air.size() && k < kTable8_3.size(); ++k) {
    const auto& air = results.fast_air[k].run;
    const auto& water = results.fast_water[k].run;
    const bool met = 1e3 * std::max(air.peak_m, water.peak_m) < kTable8_3[k].position_error_mm &&
                     air.trouble.empty() && water.trouble.empty();
    text += fmt::format("| {:.0f} | {:.3g} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {} |\n",
                        1e3 * results.fast_air[k].speed_m_per_s, kTable8_3[k].position_error_mm,
                        1e3 * air.peak_m, 1e3 * water.peak_m, 1e3 * water.carriage_mean_m,
                        1e3 * water.carriage_peak_m, met ? "met" : "MISSED");
  }
  text += fmt::format(
      "\nEach run is an S-curve, 0.8 s to speed and averaged over 0.243 s. The motor's peak comes "
      "where the acceleration changes, so it\ndepends on the ramp: at 50 mm/s in air a trapezoid "
      "of "
      "0.8 s has {:.3f} mm and one of 0.3 s, BBMC's default, {:.3f} mm.\n",
      1e3 * results.straight_ramps[0].run.peak_m, 1e3 * results.straight_ramps[1].run.peak_m);
  return text;
}

const TowResult* tow_of(const Results& results, std::string_view id) {
  for (const auto& each : results.tows) {
    if (each.id == id) {
      return &each;
    }
  }
  return nullptr;
}

std::string markdown(const procedures::ResultTable& table) {
  std::string text = fmt::format("\n{}\n\n| {} |\n|", table.title, fmt::join(table.head, " | "));
  for (std::size_t i = 0; i < table.head.size(); ++i) {
    text += " --- |";
  }
  text += "\n";
  for (const auto& row : table.rows) {
    text += fmt::format("| {} |\n", fmt::join(row, " | "));
  }
  return text;
}

std::string tuning(const Results& results) {
  std::string text =
      "\n## Tuning: by the model, by Table 4.1, by the thesis\n\nPoles placed on the model that "
      "EXP-OL-2 has found (`study/identify/pole_placement.h`). Stiff: the fastest loop within the\n"
      "sensitivity M_s; the carriage swings behind it nearly undamped. Transmission damped: no "
      "pole "
      "decays "
      "slower than the placed ones.\n";
  for (const auto& step : results.identified.steps) {
    if (step.id != "pole-placement") {
      continue;
    }
    for (const auto& table : step.outcome.tables) {
      text += fmt::format("\nAxis {}.{}", core::name_of(step.axis), markdown(table));
    }
  }
  return text;
}

std::string recovered(const TowResult& tow) {
  if (tow.recoveries.empty()) {
    return {};
  }
  std::string text =
      "\n| quantity | bench | 95 % | expected | error | demand |\n| --- | --- | --- | --- | --- | "
      "--- |\n";
  for (const auto& r : tow.recoveries) {
    const auto& e = r.estimate;
    const auto interval = e.no_interval.empty() ? fmt::format("{:.5g} .. {:.5g}", e.low, e.high)
                                                : std::string("withheld");
    const char* judged = r.agrees ? r.narrow ? "met" : "met, interval TOO WIDE" : "MISSED";
    const auto demand =
        r.tolerance_pct > 0 ? fmt::format("{} % {}", r.tolerance_pct, judged) : std::string("none");
    text += fmt::format("| {}{} | {:.5g} | {} | {:.5g} | {:+.2f} % | {} |\n", e.quantity,
                        e.at ? fmt::format(" at {:.3g}", *e.at) : "", e.value, interval, r.truth,
                        r.error_pct, demand);
  }
  return text;
}

double truth_of_drag(const TowResult& exp_1) {
  for (const auto& each : exp_1.recoveries) {
    if (each.estimate.quantity == "fsm_drag_N_s2_per_m2") {
      return each.truth;
    }
  }
  return NAN;
}

std::string drag_tables(const Results& results) {
  const auto* exp_1 = tow_of(results, "EXP-1");
  if (exp_1 == nullptr || exp_1->outcome.tables.size() < 3) {
    return "\n## Tables 8.2, 8.4\n\nnot measured\n";
  }
  std::string text = "\n## Table 8.2: the model of Y that predicts drag\n";
  text += markdown(exp_1->outcome.tables[0]);
  text +=
      "\nTruth: the row of Table 7.4, friction by place in C. Errata: the table prints R = 5.5 m "
      "(5.5 cm, disputed: 5.0 cm by the "
      "firmware),\nB in N s, and an amplifier gain of 0.352 against 0.37 of Table 7.1; the set as "
      "printed is "
      "`fixtures/rigs/table-8.2.toml`.\n";
  text += "\n## Table 8.4: drag by the three methods\n";
  text += markdown(exp_1->outcome.tables[2]);
  text += fmt::format(
      "\nTruth: {:.2f} N s2/m2.\n"
      "\nErrata. Table 8.4 prints 878, 839 and 797 N s2/m2; 878 would be 266 N at 0.55 m/s, four "
      "times what the drive can push, "
      "so the\nexponent is wrong: 8.78. (8.4) has tau_m and (R/n) F_D on the wrong sides: tau_m = "
      "f_ss + (R/n) F_D, from which (8.5) "
      "is right.\n",
      truth_of_drag(*exp_1));
  text +=
      "\nWhy the model-based prediction is off. (8.6) takes every friction that its model does not "
      "know for drag, so a model that is "
      "blind\nto places carries the difference in friction between where one tows and where one "
      "identified:\n"
      "dF_k = (n/R)(u_k - L(w_k)), dD = sum v_k^2 dF_k / sum v_k^4, with u the mean of friction by "
      "place and of Stribeck friction "
      "over the\nstretch of speed w_k, and L the least-squares line through those of the "
      "identification "
      "(`study/recovery/tow/blind_model_bias.h`).\nIdentified where the tows begin, friction is "
      "lower "
      "there than on the way: too much drag. "
      "Identified in mid tank, as 7.2.1 did,\nfriction is higher there: too little, as in the "
      "thesis (-9 %). So a machine whose track "
      "runs hardest in mid tank, identified\nthere and towed from the near end, gives the thesis's "
      "sign and about its size. The expected "
      "column below is that closed form.\n";
  return text;
}

}  // namespace

std::string results_page(const Results& results) {
  std::string text = fmt::format(
      "# Results: the thesis's tables, the bench, the truth\n\n"
      "Machine `{}`, plain PID of `bbmc-tuned`. `./towbench results` writes this page. Bench: "
      "estimated from what a bench logs, with "
      "95 %\nintervals. Truth: what the emulated machine is, which no estimator sees.\n\n",
      results.rig);
  text += identification_tables(results.truth, results.identified);
  text += tuning(results);
  text += tracking(results);
  text += fast_tracking(results);
  text += own_gains_tables(results.own_gains);
  text += drag_tables(results);
  text += "\n## Tow experiments, every estimate against its demand\n";
  for (const auto& tow : results.tows) {
    text += fmt::format("\n### {}: {}\n", tow.id, tow.title);
    if (tow.outcome.status != procedures::ProcedureOutcome::Status::kDone) {
      text += "\n" + tow.outcome.reason + "\n";
    }
    text += recovered(tow);
    if (tow.id != "EXP-1") {
      for (const auto& table : tow.outcome.tables) {
        text += markdown(table);
      }
    }
  }
  return text;
}

}  // namespace towbench::study
