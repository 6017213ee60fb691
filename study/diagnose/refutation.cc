#include "study/diagnose/refutation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "study/diagnose/own_values.h"
#include "study/statistics/statistics.h"

namespace towbench::study::diagnose {
namespace {

// Of the prediction error: less may be a law that does not fit quite.
constexpr double kWorse = 0.02;       // of held-out runs, than without the causes
constexpr double kWorseStated = 0.1;  // of held-out runs, than by the stated model
constexpr double kMuchWorse = 0.5;    // of fitted runs

// Squares block by block, if all of each run decides what it has of its own.
struct Losses {
  Eigen::VectorXd stated, before, after;
  std::vector<Span> spans;
};

Losses losses_of(const Data& data, const Search& search) {
  const Parameters& extended = search.final.fitted.model.parameters;
  const double w = force_bandwidth(search.context, extended[Key::kMass]);
  const std::vector<Span> spans = cut(data, w);
  const auto side = [&](const Parameters& p) -> Eigen::VectorXd {
    const Model model = with_own_values(data, search.context, p, 1, w);
    // A heavier body hides more of the forces that no model has.
    const double heavier = std::max(1.0, p[Key::kMass] / extended[Key::kMass]);
    return heavier * heavier * squares_of(innovations(data, model, w), spans);
  };
  return {side(parameters_of(search.context.stated)), side(search.base.fitted.model.parameters),
          side(extended), spans};
}

bool is_worse(const Eigen::VectorXd& before, const Eigen::VectorXd& after, double much) {
  const Comparison c = compare(before, after, statistics::kNormal95);
  return c.gain < -much && c.high < 0;
}

// Held-out runs: worse than by the stated structure, or by the stated model.
bool speak_against(const std::vector<Run>& holdout, const Data& fitted, const Search& search) {
  if (holdout.empty()) return false;
  const NominalModel& stated = search.context.stated;
  const Losses losses = losses_of(make_data_like(fitted, holdout, stated), search);
  return is_worse(losses.before, losses.after, kWorse) ||
         (stated.supplied && is_worse(losses.stated, losses.after, kWorseStated));
}

// One of the fitted runs is predicted worse than by the stated model, for the sake of another.
bool one_speaks_against(const Data& data, const Search& search) {
  if (!search.context.stated.supplied) return false;
  const Losses losses = losses_of(data, search);
  for (std::size_t run = 0; run < data.scenes.size(); ++run) {
    std::vector<Eigen::Index> here;
    for (std::size_t i = 0; i < losses.spans.size(); ++i) {
      const Span& span = losses.spans[i];
      if (span.from >= data.starts[run] && span.to <= data.starts[run + 1]) {
        here.push_back(static_cast<Eigen::Index>(i));
      }
    }
    if (is_worse(losses.stated(here), losses.after(here), kMuchWorse)) return true;
  }
  return false;
}

bool is_refuted(const std::vector<Run>& holdout, const Data& fitted, const Search& search) {
  return speak_against(holdout, fitted, search) || one_speaks_against(fitted, search);
}

bool has_moved(const ParameterShift& shift) {
  return shift.moved;
}

// Of its distance from what is stated.
double p_value_of(const ParameterShift& shift) {
  const double error = (shift.fitted.high - shift.fitted.low) / (2 * statistics::kNormal95);
  return std::erfc(std::abs(shift.fitted.value - shift.supplied) / (error * std::numbers::sqrt2));
}

// What a fit takes of the prediction error, though held-out runs do not have it.
Unexplained taken(double before_rms_N, double after_rms_N, double p_value) {
  const double squares = before_rms_N * before_rms_N - after_rms_N * after_rms_N;
  return {.coordinate = kWholeMotion,
          .share = 1 - after_rms_N / before_rms_N,
          .rms_N = std::sqrt(std::max(0.0, squares)),
          .p_value = p_value};
}

}  // namespace

void refute_causes(Diagnosis& d, const std::vector<Run>& holdout, const Data& fitted,
                   Search& search) {
  if (search.causes.empty() || !is_refuted(holdout, fitted, search)) return;
  const Scored within = score_within(fitted, search);
  double least_p = 1;
  for (const Cause& cause : search.causes) {
    d.refuted.push_back(cause.effect->name);
    least_p = std::min(least_p, cause.p_value);
  }
  d.unexplained = taken(within.before_rms_N, within.after_rms_N, least_p);
  search.causes.clear();
  search.final = search.base;
}

void refute_parameters(Diagnosis& d, const std::vector<Run>& holdout, const Data& fitted,
                       const Search& search) {
  if (std::none_of(d.parameters.begin(), d.parameters.end(), has_moved)) return;
  if (d.refuted.empty()) {
    if (!search.causes.empty() || !is_refuted(holdout, fitted, search)) return;
    const Scored within = score_within(fitted, search);
    double least_p = 1;
    for (const ParameterShift& shift : d.parameters) {
      if (!shift.moved) continue;
      d.refuted.push_back(shift.name);
      least_p = std::min(least_p, p_value_of(shift));
    }
    d.unexplained = taken(within.supplied_rms_N, within.after_rms_N, least_p);
  }
  for (ParameterShift& shift : d.parameters) shift.moved = false;
}

}  // namespace towbench::study::diagnose
