#include "study/diagnose/model_checks.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "study/diagnose/wald.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLongestShift_s = 0.25;
constexpr double kToldShift_s = 0.02;
constexpr double kLeastExplained = 0.3;

// Share of the input's energy about its mean that the structure explains when the input is moved.
double explained_at(const Dataset& data, const MatrixXd& basis, Index shift) {
  const MatrixXd y = data.stack([&](const Signals& s) -> MatrixXd {
    const Index n = s.size();
    VectorXd moved(n);
    for (Index i = 0; i < n; ++i) {
      moved[i] = s.input_N[std::clamp<Index>(i + shift, 0, n - 1)];
    }
    return moved;
  });
  const VectorXd centred = y.array() - y.mean();
  return 1 - projected_off(basis, centred).squaredNorm() / std::max(1e-300, centred.squaredNorm());
}

// Below this share the structure has been met by data that are not its own.
constexpr double kNothingExplained = 0.05;
constexpr double kWellExplained = 0.9;

void check_shift(const Dataset& data, const MatrixXd& basis, double aligned, Findings& findings) {
  const double T = data.members.front().signals.period_s;
  const auto longest = static_cast<Index>(kLongestShift_s / T);
  const Index step = std::max<Index>(1, longest / 25);
  Index best = 0;
  double most = aligned;
  for (Index shift = -longest; shift <= longest; shift += step) {
    const double explained = explained_at(data, basis, shift);
    if (explained > most) {
      most = explained;
      best = shift;
    }
  }
  const double seconds = static_cast<double>(best) * T;
  if (std::abs(seconds) >= kToldShift_s && (1 - most) < 0.7 * (1 - aligned)) {
    // y(t + shift) fits x(t) best: the input column is late by the shift.
    findings.push_back(
        {aligned < kWellExplained ? Finding::Kind::kFatal : Finding::Kind::kNote, "columns_shifted",
         fmt::format("the input column lies about {:.0f} ms {} the position column: the model "
                     "explains {:.0f} % of it there and {:.0f} % where it is; align them first",
                     1e3 * std::abs(seconds), seconds > 0 ? "behind" : "ahead of", 100 * most,
                     100 * aligned)});
  } else if (most < kNothingExplained) {
    findings.push_back({Finding::Kind::kFatal, "model_explains_nothing",
                        fmt::format("inertia and friction together explain {:.1f} % of the input, "
                                    "and no shift of the columns makes it more: noise, or the "
                                    "wrong columns",
                                    100 * most)});
  }
}

void check_unit(const Context& c, Findings& findings) {
  if (!c.model.supplied || c.model.mass_kg <= 0) {
    return;
  }
  const double ratio = std::abs(c.theta[kMass]) / c.model.mass_kg;
  const double decades = std::log10(std::max(1e-30, ratio));
  if (std::abs(decades) < 1.3) {
    return;
  }
  const char* guess = "a scale factor is missing, or the model is of another machine";
  if (std::abs(std::abs(decades) - 3) < 0.3) {
    guess = decades > 0 ? "the input is in thousandths or the position in thousands (mm for m?)"
                        : "the input is in thousands or the position is in mm read as m";
  } else if (std::abs(std::abs(decades) - 2) < 0.3) {
    guess = decades > 0 ? "the input is in hundredths or the position in hundreds (cm for m?)"
                        : "the input is a ratio and no percentage, or the position is in cm";
  } else if (c.model.metres_per_count > 0 &&
             std::abs(std::abs(decades) + std::log10(c.model.metres_per_count)) < 0.3) {
    guess = decades > 0 ? "the position is in metres and mapped as counts"
                        : "the position is in counts and mapped as metres";
  }
  findings.push_back(
      {Finding::Kind::kFatal, "input_unit_off",
       fmt::format("the data ask for {:.3g} times the model's inertia: {}", ratio, guess)});
}

}  // namespace

void check_against_model(const Dataset& data, const Context& c, Findings& findings) {
  const MatrixXd basis = orthonormal(data.stack(base_columns));
  const double aligned = explained_at(data, basis, 0);
  check_shift(data, basis, aligned, findings);
  if (is_fatal(findings)) {
    return;
  }
  if (c.theta[kMass] < 0 && c.theta[kCoulomb] < 0) {
    findings.push_back({Finding::Kind::kFatal, "command_sign_reversed",
                        "inertia and friction come out negative: the sign of the command is "
                        "reversed against the position's"});
    return;
  }
  if (aligned < kLeastExplained) {
    findings.push_back({Finding::Kind::kNote, "model_explains_little",
                        fmt::format("inertia and friction together explain {:.0f} % of the input; "
                                    "are the right columns mapped?",
                                    100 * aligned)});
  }
  check_unit(c, findings);
}

}  // namespace towbench::harness::diagnose
