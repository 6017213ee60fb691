#include "study/diagnose/parameters.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "study/diagnose/motion.h"
#include "study/prediction/units.h"
#include "study/statistics/statistics.h"

namespace towbench::study::diagnose {
namespace {

constexpr int kRounds = 8;            // of a fit
constexpr double kMovedErrors = 4;    // standard errors
constexpr double kMovedShare = 0.01;  // of the input's rms, and of what is stated
constexpr double kBesideMuch = 0.05;  // the same where much is left that nothing explains
constexpr double kNeeded = 2;         // standard errors by which it predicts better than as stated
constexpr double kBesidePlay = 0.1;   // and the motor is free of its load now and then

// Rms of what multiplies mass and viscous friction.
struct Sizes {
  double acceleration = 0;
  double speed = 0;
};

Sizes sizes_in(const Data& data) {
  Sizes sum;
  for (const Scene& scene : data.scenes) {
    const Motion m = motion_of(*scene.run, kSmooth_s);
    sum.acceleration += m.acceleration_m_per_s2.squaredNorm();
    sum.speed += m.speed_m_per_s.squaredNorm();
  }
  const auto n = static_cast<double>(data.samples());
  return {std::sqrt(sum.acceleration / n), std::sqrt(sum.speed / n)};
}

// Of the input's rms, of what is off by less nothing is said.
double least_share(const Search& search) {
  if (!search.structured) return kMovedShare;
  const bool plays = std::any_of(search.causes.begin(), search.causes.end(),
                                 [](const Cause& cause) { return cause.effect->rough; });
  return plays ? kBesidePlay : kBesideMuch;
}

// The fit with the causes ends near one of its minima: as stated, with all else fitted again, the
// parameter must predict surely worse. Dry friction and offset are each run's own as well.
bool is_needed(const Data& data, const Search& search, Key key, double stated) {
  const bool of_all_runs = key == Key::kMass || key == Key::kViscous;
  if (search.causes.empty() || !of_all_runs) return true;
  Model from = search.final.fitted.model;
  from.parameters[key] = stated;
  std::vector<FreeParameter> free = search.final.free;
  std::erase_if(free, [&](const FreeParameter& f) {
    return f.key == key && f.of == FreeParameter::Of::kAll;
  });
  const Fitted as_stated =
      fit_model(data, search.context, from, free, search.bandwidth, search.spans, kRounds);
  return compare(squares_of(as_stated.e, search.spans),
                 squares_of(search.final.fitted.e, search.spans), kNeeded)
             .standard_errors > kNeeded;
}

// So many times their spread is as sure for a mean of `n` as kMovedErrors standard errors are.
double spreads_of_few(double n) {
  const double beyond = boost::math::cdf(complement(boost::math::normal(), kMovedErrors));
  return boost::math::quantile(complement(boost::math::students_t(n - 1), beyond));
}

// Standard error of a mean over runs that differ, each known to `error_N`. Of few the spread says
// little: they may all be off by what runs usually differ by, unless they hardly differ.
double of_runs(const Model& model, Key key, double error_N, double usual_N, bool some_left_out) {
  const auto n = static_cast<double>(model.of_run.size());
  if (key != Key::kBias && key != Key::kCoulomb) return 0;
  const double least_N = usual_N / (kMovedErrors * std::sqrt(n));
  if (n < 2) return some_left_out ? least_N : 0;
  double square = 0;
  for (const OfRun& run : model.of_run) {
    const double own = key == Key::kBias ? run.bias_N : run.coulomb_N;
    square += own * own;
  }
  const double spread_N = std::sqrt(square / (n - 1) / n);
  const double of_few_N = spreads_of_few(n) / kMovedErrors * std::max(spread_N, error_N);
  return std::max(spread_N, std::min(least_N, of_few_N));
}

// fitted / supplied with its standard error.
struct Ratio {
  double value = 1;
  double error = 0;
};

double error_of(const Interval& ci95) {
  return (ci95.high - ci95.low) / (2 * statistics::kNormal95);
}

Ratio ratio_of(const ParameterShift& shift) {
  return {shift.fitted.value / shift.supplied, error_of(shift.fitted) / std::abs(shift.supplied)};
}

constexpr double kOffAlike = 0.1;  // of how much is off

bool agree(const Ratio& a, const Ratio& b) {
  return std::abs(a.value - b.value) <
         std::max(3 * std::hypot(a.error, b.error), kOffAlike * std::abs(a.value - 1));
}

// What may stand behind a shift of inertia, of viscous and of Coulomb friction, each.
using Behind = std::array<std::vector<std::string>, 3>;

constexpr const char* kGain = "amplifier_gain";
constexpr const char* kCounts = "encoder_count_loss";

Behind behind(const std::vector<ParameterShift>& shifts) {
  if (shifts[kViscousFriction].supplied == 0 || shifts[kDryFriction].supplied == 0) return {};
  const Ratio mass = ratio_of(shifts[kInertia]);
  const Ratio viscous = ratio_of(shifts[kViscousFriction]);
  if (!shifts[kInertia].moved) {
    // Where friction is nearly all, the rest may be off by as much without being seen.
    const Ratio dry = ratio_of(shifts[kDryFriction]);
    const bool by_gain = agree(dry, mass) && agree(dry, viscous);
    return by_gain ? Behind{{{}, {kGain}, {kGain}}} : Behind{};
  }
  if (!agree(mass, viscous)) {
    return {};
  }
  // Lost counts scale what moves, a wrong gain that and what only rubs.
  const bool by_gain = agree(mass, ratio_of(shifts[kDryFriction]));
  const bool rubs_as_stated = !shifts[kDryFriction].moved;
  if (!by_gain && !rubs_as_stated) {
    const bool viscous_is_off = std::abs(viscous.value - 1) >= 3 * viscous.error;
    return viscous_is_off ? Behind{{{kCounts}, {kCounts}, {kGain}}} : Behind{};
  }
  std::vector<std::string> one;
  if (by_gain) one.emplace_back(kGain);
  if (rubs_as_stated) one.emplace_back(kCounts);
  return {one, one, one};
}

}  // namespace

void add_once(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

namespace {

// What predicts as well as a named cause, and needs no shift of this parameter.
void add_what_needs_none(const Search& search, Key key, ParameterShift& shift) {
  const double most = kOffAlike * std::abs(shift.fitted.value - shift.supplied);
  for (const Cause& cause : search.causes) {
    for (const Alternative& other : cause.alternatives) {
      if (std::abs(other.state.fitted.model.parameters[key] - shift.supplied) < most) {
        add_once(shift.indistinguishable_from, other.effect->name);
      }
    }
  }
}

}  // namespace

std::vector<ParameterShift> judge_parameters(const Data& data, const Search& search,
                                             bool some_left_out) {
  const NominalModel& model = search.context.stated;
  const Units of = units_of(model);
  const std::array<std::string_view, 4> units{of.mass, of.viscous, of.force, of.force};
  const std::array<double, 4> supplied{model.mass_kg, model.viscous_N_s_per_m, model.coulomb_N,
                                       model.bias_N};
  const std::array<Key, 4> keys{Key::kMass, Key::kViscous, Key::kCoulomb, Key::kBias};
  const Sizes sizes = sizes_in(data);
  const double usual_N = runs_differ_N(search.context);
  const std::array<double, 4> columns{sizes.acceleration, sizes.speed, 1, 1};
  std::vector<ParameterShift> shifts;
  const std::size_t fitted = search.context.one_way != 0 ? kConstantForce : kParameterNames.size();
  for (std::size_t i = 0; i < fitted; ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    const double own_error = std::sqrt(std::max(0.0, search.final.linear.covariance(j, j)));
    const double error = std::hypot(
        own_error, of_runs(search.final.fitted.model, keys[i], own_error, usual_N, some_left_out));
    const double value = search.final.fitted.model.parameters[keys[i]];
    const double off = value - supplied[i];
    const bool shared =
        std::any_of(search.causes.begin(), search.causes.end(),
                    [&](const Cause& c) { return c.effect->shares_mean_with == keys[i]; });
    const bool moved =
        model.supplied && !shared && std::abs(off) > kMovedErrors * error &&
        std::abs(off) > kMovedShare * std::abs(supplied[i]) &&
        std::abs(off) * columns[i] > least_share(search) * search.context.input_rms_N &&
        is_needed(data, search, keys[i], supplied[i]);
    shifts.push_back(
        {kParameterNames[i],
         supplied[i],
         {value, value - statistics::kNormal95 * error, value + statistics::kNormal95 * error},
         std::string(units[i]),
         moved,
         {}});
  }
  if (shifts[kInertia].moved) {
    shifts[kInertia].indistinguishable_from = {"added_mass"};
  }
  const std::vector<std::string> constant_forces{"constant_bias", "coulomb_asymmetry"};
  if (search.context.one_way != 0) {
    if (shifts[kDryFriction].moved) shifts[kDryFriction].indistinguishable_from = constant_forces;
  } else if (shifts[kConstantForce].moved) {
    shifts[kConstantForce].indistinguishable_from = constant_forces;
  }
  const Behind causes = behind(shifts);
  for (std::size_t i = 0; i < causes.size(); ++i) {
    auto& alike = shifts[i].indistinguishable_from;
    if (shifts[i].moved) alike.insert(alike.end(), causes[i].begin(), causes[i].end());
  }
  for (std::size_t i = 0; i < fitted; ++i) {
    if (shifts[i].moved) add_what_needs_none(search, keys[i], shifts[i]);
  }
  return shifts;
}

bool may_be_gain(const std::vector<ParameterShift>& shifts) {
  const Behind causes = behind(shifts);
  return std::all_of(causes.begin(), causes.end(), [](const auto& of_one) {
    return std::find(of_one.begin(), of_one.end(), kGain) != of_one.end();
  });
}

bool may_be_gain(const std::vector<ParameterShift>& shifts, const Interval& sine_Nm,
                 const Interval& cosine_Nm, const Parameters& stated) {
  const double size_Nm = std::hypot(stated[Key::kGravitySine], stated[Key::kGravityCosine]);
  if (size_Nm == 0 || !may_be_gain(shifts)) return false;
  const Ratio mass = ratio_of(shifts[kInertia]);
  const double off_Nm = std::hypot(sine_Nm.value - mass.value * stated[Key::kGravitySine],
                                   cosine_Nm.value - mass.value * stated[Key::kGravityCosine]);
  const double error =
      std::hypot(error_of(sine_Nm) / size_Nm, error_of(cosine_Nm) / size_Nm, mass.error);
  return off_Nm / size_Nm < std::max(3 * error, kOffAlike * std::abs(mass.value - 1));
}

}  // namespace towbench::study::diagnose
