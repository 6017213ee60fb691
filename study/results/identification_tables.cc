#include "study/results/identification_tables.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "study/recovery/recovery.h"

namespace towbench::study {
namespace {

using core::Axis;
using identify::Estimate;

constexpr const char* kHead =
    "| quantity | thesis | bench (95 %) | truth | error |\n| --- | --- | --- | --- | --- |\n";

struct Wanted {
  const char* words;
  const char* quantity;
  const char* thesis;
};

// A map has one row a place.
std::string rows_of(const emulator::RigParameters& truth, const identify::Estimates& estimates,
                    std::string_view axis, const Wanted& wanted) {
  std::string text;
  for (const auto& each : estimates) {
    if (each.quantity != wanted.quantity || each.axis != axis) {
      continue;
    }
    const auto place = each.at ? fmt::format(" at {:.3g}", *each.at) : std::string();
    text += fmt::format("| {}{} | {} | {:.4g} ({:.4g} .. {:.4g}) |", wanted.words, place,
                        wanted.thesis, each.value, each.low, each.high);
    const auto judged = judge_recovery(truth, {each});
    text += judged.empty() ? " - | - |\n"
                           : fmt::format(" {:.4g} | {:+.2f} % of {:.2g} %, {} |\n", judged[0].truth,
                                         judged[0].error_pct, judged[0].tolerance_pct,
                                         judged[0].agrees ? "met" : "MISSED");
  }
  return text.empty()
             ? fmt::format("| {} | {} | not measured | - | - |\n", wanted.words, wanted.thesis)
             : text;
}

std::string table_7_1(const emulator::RigParameters& truth, const identify::Estimates& estimates) {
  const auto& y = truth.axes[Axis::kY];
  std::string text = "## Table 7.1: actuator parameters, Y\n\n";
  text += kHead;
  for (const Wanted& each : {Wanted{"K_T, N m/A", "torque_constant_Nm_per_A", "26.7e-3"},
                             Wanted{"K_amp, A/V", "amplifier_gain_A_per_V", "0.37"}}) {
    text += rows_of(truth, estimates, "y", each);
  }
  text += fmt::format("| I_max, A | 3.7 | K_amp times the PWM amplitude | {:.4g} | - |\n",
                      y.plant.current_limit_A);
  text += fmt::format("| PWM amplitude, V | 10 | by its circuit | {:.4g} | - |\n",
                      y.command.pwm_amplitude_V);
  return text;
}

std::string preliminary(const emulator::RigParameters& truth,
                        const identify::Estimates& estimates) {
  std::string text = "\n## Preliminary experiments (4.1.2)\n\n";
  for (const std::string_view axis : {"y", "x"}) {
    text += fmt::format("Axis {}\n\n{}", axis, kHead);
    for (const Wanted& each :
         {Wanted{"K_T, N m/A", "torque_constant_Nm_per_A", "-"},
          Wanted{"K_amp, A/V", "amplifier_gain_A_per_V", "-"},
          Wanted{"EXP-P-2: J/B, s", "mechanical_time_constant_s", "-"},
          Wanted{"EXP-P-3: saturation speed, m/s", "saturation_speed_m_per_s", "-"},
          Wanted{"EXP-P-4: smallest duty to it within J/B, %", "smallest_command_pct", "-"},
          Wanted{"EXP-P-5: between the switches, m", "hall_distance_m", "-"},
          Wanted{"tuning: K_C, N m/rad, amplitude in m", "critical_gain_Nm_per_rad", "-"},
          Wanted{"tuning: T_C, s", "critical_period_s", "-"}}) {
      text += rows_of(truth, estimates, axis, each);
    }
    text += "\n";
  }
  return text;
}

std::string dynamics(const emulator::RigParameters& truth, const identify::Estimates& estimates) {
  std::string text = "\n## Table 7.4: effective dynamics of Y, and (7.2)\n\n";
  text += kHead;
  for (const Wanted& each :
       {Wanted{"J_eff, kg m2", "inertia_kg_m2", "1.714e-5"},
        Wanted{"B_eff, N m s/rad", "viscous_friction_Nm_s_per_rad", "1.106e-5"},
        Wanted{"C_eff, N m, place in m", "coulomb_friction_Nm", "2.26e-3"},
        Wanted{"the same, from steady runs", "sliding_friction_Nm", "2.26e-3"},
        Wanted{"break-away, N m, place in m", "breakaway_Nm", "3.7e-3"},
        Wanted{"transmission mode, Hz", "transmission_resonance_Hz", "seen, not identified"},
        Wanted{"its damping", "transmission_damping_ratio", "seen, not identified"},
        Wanted{"Stribeck speed, rad/s", "stribeck_speed_rad_per_s", "not reached"},
        Wanted{"the same, EXP-CL-1", "map_stribeck_rad_per_s", "not reached"},
        Wanted{"gain of the model on fresh motions", "validation_gain", "-"},
        Wanted{"duty of fresh motions unexplained, %", "validation_unexplained_pct", "-"}}) {
    text += rows_of(truth, estimates, "y", each);
  }
  text +=
      "\nErratum: the table's unit of B, N s, is a misprint for N m s/rad. The thesis's C is one "
      "number for the\nwhole track; the emulated machine has it at the ends and up to 1.6e-3 N m "
      "more in mid tank, so C and break-away\nare maps here.\n\n### Axis X (the thesis gives no "
      "numbers)\n\nThe controller's belief of X is the emulated machine's truth, so there is "
      "nothing to "
      "gain on it.\n\n";
  text += kHead;
  for (const Wanted& each :
       {Wanted{"J_eff, kg m2", "inertia_kg_m2", "-"},
        Wanted{"B_eff, N m s/rad", "viscous_friction_Nm_s_per_rad", "-"},
        Wanted{"C_eff, N m, place in m", "coulomb_friction_Nm", "-"},
        Wanted{"break-away, N m, place in m", "breakaway_Nm", "-"},
        Wanted{"transmission mode, Hz", "transmission_resonance_Hz", "-"},
        Wanted{"its damping", "transmission_damping_ratio", "-"},
        Wanted{"Stribeck speed, rad/s", "stribeck_speed_rad_per_s", "-"},
        Wanted{"the same, EXP-CL-1", "map_stribeck_rad_per_s", "-"},
        Wanted{"duty of fresh motions unexplained, %", "validation_unexplained_pct", "-"},
        Wanted{"gain of the model on fresh motions", "validation_gain", "-"}}) {
    text += rows_of(truth, estimates, "x", each);
  }
  return text;
}

// Ordinary least squares beside output error, as EXP-OL-2 tells them.
std::string least_squares(const procedures::SequenceResult& identified) {
  std::string text =
      "\n7.2.1 filters the transmission's oscillation out before (4.9), by a Gaussian whose width "
      "it does "
      "not state. On Y a cut-off at the\ntransmission's mode or above it misses the carriage; "
      "below it J "
      "is near, and B and C carry friction by place and the filter on\nsgn.\n";
  for (const auto& step : identified.steps) {
    if (step.id != "EXP-OL-2") {
      continue;
    }
    for (const auto& table : step.outcome.tables) {
      text += fmt::format("\nAxis {}: {}\n\n| {} |\n|", core::name_of(step.axis), table.title,
                          fmt::join(table.head, " | "));
      for (std::size_t i = 0; i < table.head.size(); ++i) {
        text += " --- |";
      }
      text += "\n";
      for (const auto& row : table.rows) {
        text += fmt::format("| {} |\n", fmt::join(row, " | "));
      }
    }
  }
  return text;
}

std::string not_done(const procedures::SequenceResult& identified) {
  std::string text;
  for (const auto& step : identified.steps) {
    if (step.outcome.status != procedures::ProcedureOutcome::Status::kDone) {
      text +=
          fmt::format("- {} on {}: {}\n", step.id, core::name_of(step.axis), step.outcome.reason);
    }
  }
  return text.empty() ? text : "\nRefused or failed:\n" + text;
}

}  // namespace

std::string identification_tables(const emulator::RigParameters& truth,
                                  const procedures::SequenceResult& identified) {
  std::string text = table_7_1(truth, identified.estimates);
  text += preliminary(truth, identified.estimates);
  text += dynamics(truth, identified.estimates);
  text += least_squares(identified);
  text += not_done(identified);
  text +=
      "\n## Table 7.5: the thesis's hand adaptation\n\n"
      "J/0.8, B/0.8 and 1.8/0.8 C of Table 7.4 (7.6), (7.7), an \"intuitive guess\" against the "
      "missing friction by place.\n\n| quantity | thesis | bench | truth |\n| --- | --- | --- | "
      "--- "
      "|\n";
  const auto& plant = truth.axes[Axis::kY].plant;
  const auto row = [&](const char* words, const char* thesis, const char* quantity, double true_) {
    const auto* found = identify::find(identified.estimates, quantity, "y");
    text += fmt::format("| {} | {} | {} | {:.4g} |\n", words, thesis,
                        found == nullptr ? "by place, above" : fmt::format("{:.4g}", found->value),
                        true_);
  };
  row("J, kg m2", "2.1425e-5", "inertia_kg_m2", plant.inertia_kg_m2);
  row("B, N m s/rad", "1.3825e-5", "viscous_friction_Nm_s_per_rad",
      plant.viscous_friction_Nm_s_per_rad);
  row("C, N m", "5.085e-3", "coulomb_friction_Nm", plant.coulomb_friction_Nm);
  text +=
      "\nThe bench needs no such step: friction by place is in its model. A machine with Table "
      "7.5's own values is\n`fixtures/rigs/table-7.5.toml`.\n";
  return text;
}

}  // namespace towbench::study
