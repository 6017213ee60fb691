#include "study/diagnose/parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace towbench::harness::diagnose {
namespace {

// fitted / supplied with its standard error.
struct Ratio {
  double value = 1;
  double error = 0;
};

Ratio ratio_of(const ParameterShift& shift) {
  const double error = (shift.fitted.high - shift.fitted.low) / (2 * 1.96);
  return {shift.fitted.value / shift.supplied, error / std::abs(shift.supplied)};
}

bool agree(const Ratio& a, const Ratio& b) {
  return std::abs(a.value - b.value) <
         std::max(3 * std::hypot(a.error, b.error), 0.1 * std::abs(a.value - 1));
}

bool shared(const std::vector<Term>& causes, Eigen::Index column) {
  return std::any_of(causes.begin(), causes.end(),
                     [&](const Term& term) { return term.effect->shares_mean_with == column; });
}

// What stands behind inertia, viscous and Coulomb friction together; empty: nothing does.
using Common = std::array<std::string, 3>;

Common common_causes(const std::vector<ParameterShift>& shifts) {
  if (!shifts[kMass].moved || shifts[kViscous].supplied == 0 || shifts[kCoulomb].supplied == 0) {
    return {};
  }
  const Ratio mass = ratio_of(shifts[kMass]);
  const Ratio viscous = ratio_of(shifts[kViscous]);
  const Ratio coulomb = ratio_of(shifts[kCoulomb]);
  if (agree(mass, coulomb) && agree(mass, viscous)) {
    return {"amplifier_gain", "amplifier_gain", "amplifier_gain"};
  }
  if (!agree(mass, viscous) || std::abs(viscous.value - 1) < 3 * viscous.error) {
    return {};
  }
  if (!shifts[kCoulomb].moved) {
    return {"encoder_count_loss", "encoder_count_loss", ""};
  }
  // Lost counts scale what moves, a wrong gain that and what only rubs.
  return {"encoder_count_loss", "encoder_count_loss", "amplifier_gain"};
}

}  // namespace

std::vector<ParameterShift> judge_parameters(const NominalModel& model, const Evidence& evidence,
                                             const std::vector<Term>& causes) {
  const std::array<std::string, 4> names{"inertia", "viscous", "coulomb", "bias"};
  const std::array<std::string, 4> units{"kg", "N s/m", "N", "N"};
  const std::array<double, 4> supplied{model.mass_kg, model.viscous_N_s_per_m, model.coulomb_N,
                                       model.bias_N};
  const double force = evidence.force_rms_N;
  std::vector<ParameterShift> shifts;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    const double error = std::sqrt(std::max(0.0, evidence.covariance(j, j)));
    const double value = evidence.coefficients[j];
    const double off = value - supplied[i];
    const double column =
        evidence.x.col(j).norm() / std::sqrt(static_cast<double>(evidence.y.size()));
    const bool moved = model.supplied && !shared(causes, j) &&
                       std::abs(off) > kMovedErrors * error &&
                       std::abs(off) * column > kMovedShare * force &&
                       !(model.elastic() && std::abs(off) < kElasticFloor * std::abs(supplied[i]));
    shifts.push_back({names[i],
                      supplied[i],
                      {value, value - 1.96 * error, value + 1.96 * error},
                      units[i],
                      moved,
                      {}});
  }
  if (shifts[kMass].moved) {
    shifts[kMass].indistinguishable_from = {"added_mass"};
  }
  if (shifts[kBias].moved) {
    shifts[kBias].indistinguishable_from = {"constant_bias", "coulomb_asymmetry"};
  }
  const Common common = common_causes(shifts);
  for (std::size_t i = 0; i < common.size(); ++i) {
    if (shifts[i].moved && !common[i].empty()) {
      shifts[i].indistinguishable_from.push_back(common[i]);
    }
  }
  return shifts;
}

std::size_t things_moved(const std::vector<ParameterShift>& shifts) {
  const auto moved = static_cast<std::size_t>(std::count_if(
      shifts.begin(), shifts.end(), [](const ParameterShift& shift) { return shift.moved; }));
  std::set<std::string> causes;
  std::size_t explained = 0;
  const Common common = common_causes(shifts);
  for (std::size_t i = 0; i < common.size(); ++i) {
    if (shifts[i].moved && !common[i].empty()) {
      causes.insert(common[i]);
      ++explained;
    }
  }
  return moved - explained + causes.size();
}

std::string common_cause(const std::vector<ParameterShift>& shifts) {
  const Common common = common_causes(shifts);
  const bool of_all = common[kMass] == common[kViscous] &&
                      (common[kCoulomb].empty() || common[kCoulomb] == common[kMass]);
  return of_all ? common[kMass] : std::string{};
}

}  // namespace towbench::harness::diagnose
