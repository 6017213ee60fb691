#include "study/diagnose/model_checks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "study/prediction/effect.h"
#include "study/prediction/fit.h"

namespace towbench::study::diagnose {
namespace {

constexpr double kLongestShift_s = 0.25;
constexpr double kToldShift_s = 0.02;
constexpr double kFarLess = 0.7;  // of what is not explained
constexpr double kLeastExplained = 0.3;
constexpr Eigen::Index kFewestWindows = 30;

// Below this share, or this many windows' worth, the structure has been met by data that are not
// its own: noise reaches 25 windows' worth over all shifts once in a thousand logs.
constexpr double kNothingExplained = 0.05;
constexpr double kNoiseReaches = 25;
constexpr double kWellExplained = 0.9;
constexpr double kUnitDecades = 1.3;  // that an inertia is off by where a unit is wrong

// Of a rigid body; a load on a transmission follows later by half a period of its swing.
double told_shift_s(const NominalModel& model) {
  if (!model.elastic()) {
    return kToldShift_s;
  }
  const double load_kg = model.mass_kg - model.transmission.motor_kg;
  return kToldShift_s +
         std::numbers::pi * std::sqrt(load_kg / model.transmission.stiffness_N_per_m);
}

struct Shift {
  double seconds = 0;
  double explained = 0;
};

Shift best_shift(const std::vector<Run>& runs, const NominalModel& model, const Momentum& aligned) {
  Shift best{0, aligned.explained};
  for (double shift = -kLongestShift_s; shift <= kLongestShift_s; shift += kLongestShift_s / 25) {
    const double explained = fit_momentum(runs, model.rotary, shift, aligned.most_N).explained;
    if (explained > best.explained) best = {shift, explained};
  }
  return best;
}

std::vector<Run> shifted(std::vector<Run> runs, double seconds) {
  for (Run& run : runs) {
    const Eigen::VectorXd input_N = run.input_N;
    const auto by = static_cast<Eigen::Index>(std::lround(seconds / run.period_s));
    for (Eigen::Index i = 0; i < run.size(); ++i) {
      run.input_N[i] = input_N[std::clamp<Eigen::Index>(i + by, 0, run.size() - 1)];
    }
  }
  return runs;
}

// Of what is stated, or of the stated body on one of the springs that are tried: the least squares.
double least_square(const Data& data, const NominalModel& model, double bandwidth) {
  const auto square_of = [&](const Parameters& p) {
    const Model as_is{p, std::vector<OfRun>(data.scenes.size())};
    return innovations(data, as_is, bandwidth).squaredNorm();
  };
  double least = square_of(parameters_of(model));
  const Context context = make_context(model, data);
  const Effect& spring = *find_effect("chain_elasticity");
  if (!model.elastic()) {
    for (const Scales& scales : spring.grid(context)) {
      Parameters p = parameters_of(model);
      spring.set(p, context, scales);
      least = std::min(least, square_of(p));
    }
  }
  return least;
}

// A load that swings on its transmission looks shifted by a period of that. What is stated of the
// transmission predicts which it is, or else a spring.
bool predicts_better(const std::vector<Run>& runs, const NominalModel& model, double seconds) {
  if (!model.supplied && !model.elastic()) return true;
  const Model stated{parameters_of(model), std::vector<OfRun>(runs.size())};
  const std::vector<Run> others = shifted(runs, seconds);
  const Data as_is = make_data(runs, model);
  const Data moved = make_data(others, model);
  const auto best = [&](const Data& data) {
    return best_bandwidth(data, make_context(model, data), stated, kFollowed);
  };
  // A fast correction follows whatever it is given.
  const double slower = std::min(best(as_is), best(moved));
  return innovations(moved, stated, slower).squaredNorm() <
         kFarLess * least_square(as_is, model, slower);
}

void check_shift(const std::vector<Run>& runs, const NominalModel& model, const Momentum& fit,
                 const Shift& shift, logs::Findings& findings) {
  const double aligned = fit.explained;
  const auto [seconds, most] = shift;
  if (std::abs(seconds) >= told_shift_s(model) && (1 - most) < kFarLess * (1 - aligned) &&
      predicts_better(runs, model, seconds)) {
    // y(t + shift) fits x(t) best: the input column is late by the shift.
    findings.push_back(
        {aligned < kWellExplained ? logs::Finding::Kind::kFatal : logs::Finding::Kind::kNote,
         "columns_shifted",
         fmt::format("the input column lies about {:.0f} ms {} the position column: the model "
                     "explains {:.0f} % of it there and {:.0f} % where it is; align them first",
                     1e3 * std::abs(seconds), seconds > 0 ? "behind" : "ahead of", 100 * most,
                     100 * aligned)});
  } else if (most < std::max(kNothingExplained, kNoiseReaches / static_cast<double>(fit.windows))) {
    findings.push_back({logs::Finding::Kind::kFatal, "model_explains_nothing",
                        fmt::format("inertia and friction together explain {:.1f} % of the input, "
                                    "and no shift of the columns makes it more: noise, or the "
                                    "wrong columns",
                                    100 * most)});
  }
}

double decades_of(const Momentum& fit, const NominalModel& model) {
  return std::log10(std::max(1e-30, std::abs(fit.mass_kg) / model.mass_kg));
}

// `limited`: the same with what a clip may leave of the input.
void check_unit(const NominalModel& model, const Momentum& fit, const Momentum& limited,
                logs::Findings& findings) {
  // Where little is explained, noise in the acceleration makes the inertia too small.
  if (!model.supplied || model.mass_kg <= 0 || fit.explained < kLeastExplained) {
    return;
  }
  const double decades = decades_of(fit, model);
  if (std::abs(decades) < kUnitDecades || std::abs(decades_of(limited, model)) < kUnitDecades) {
    return;
  }
  const char* guess =
      "a scale factor is missing, the model is of another machine, or the motion is too slow to "
      "tell";
  if (std::abs(std::abs(decades) - 3) < 0.3) {
    guess = decades > 0 ? "the input is in thousandths or the position in thousands (mm for m?)"
                        : "the input is in thousands or the position is in mm read as m";
  } else if (std::abs(std::abs(decades) - 2) < 0.3) {
    guess = decades > 0 ? "the input is in hundredths or the position in hundreds (cm for m?)"
                        : "the input is a ratio and no percentage, or the position is in cm";
  } else if (model.metres_per_count > 0 &&
             std::abs(std::abs(decades) + std::log10(model.metres_per_count)) < 0.3) {
    guess = decades > 0 ? "the position is in metres and mapped as counts"
                        : "the position is in counts and mapped as metres";
  }
  findings.push_back({logs::Finding::Kind::kFatal, "input_unit_off",
                      fmt::format("the data ask for {:.3g} times the model's inertia: {}",
                                  std::pow(10, decades), guess)});
}

}  // namespace

void check_against_model(const std::vector<Run>& runs, const NominalModel& model,
                         logs::Findings& findings) {
  const Momentum fit = fit_momentum(runs, model.rotary, 0);
  if (fit.windows < kFewestWindows) {
    const auto unit = std::find_if(findings.begin(), findings.end(), [](const logs::Finding& f) {
      return f.name == "reference_unit_off";
    });
    findings.push_back(
        {logs::Finding::Kind::kFatal, "too_little_motion",
         fmt::format("{} short stretches in motion, {} are needed: {}", fit.windows, kFewestWindows,
                     unit == findings.end() ? "log longer, or give another run"
                                            : unit->name + ": " + unit->sentence)});
    return;
  }
  // A clip is believed where it explains more than any shift without one.
  const Momentum limited = fit_momentum_of_drive(runs, model.rotary);
  Shift shift = best_shift(runs, model, fit);
  const bool is_clipped = limited.explained > shift.explained;
  if (is_clipped) shift = best_shift(runs, model, limited);
  check_shift(runs, model, is_clipped ? limited : fit, shift, findings);
  if (is_fatal(findings)) {
    return;
  }
  if (fit.mass_kg < 0 && fit.coulomb_N < 0) {
    findings.push_back({logs::Finding::Kind::kFatal, "command_sign_reversed",
                        "inertia and friction come out negative: the sign of the command is "
                        "reversed against the position's, or something else drives the axis, a "
                        "hand perhaps"});
    return;
  }
  if (fit.explained < kLeastExplained) {
    findings.push_back({logs::Finding::Kind::kNote, "model_explains_little",
                        fmt::format("inertia and friction together explain {:.0f} % of the input; "
                                    "are the right columns mapped?",
                                    100 * fit.explained)});
  }
  check_unit(model, fit, is_clipped ? limited : fit, findings);
}

}  // namespace towbench::study::diagnose
