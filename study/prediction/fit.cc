#include "study/prediction/fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "study/prediction/in_parallel.h"

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRunsDiffer = 0.1;   // of the dry friction, or of the input where there is none
constexpr double kGoodEnough = 3e-5;  // relative fall of the cost that ends a fit
constexpr double kLargestFactor = 2;
constexpr double kLeastSaid = 0.6;  // of the samples that the fastest correction says something of
constexpr double kFarSpeed = 4;     // times the log's: there a level hardly falls with speed
constexpr double kFastest_per_sample = 0.25;  // bandwidth times period

// Near zero, by what runs usually differ by.
bool is_held(const FreeParameter& f) {
  return f.of == FreeParameter::Of::kBiasOfRun || f.of == FreeParameter::Of::kCoulombOfRun;
}

double penalty(const std::vector<FreeParameter>& free, const VectorXd& ridge, Model& model) {
  double sum = 0;
  for (std::size_t j = 0; j < free.size(); ++j) {
    const double v = value_in(model, free[j]);
    sum += is_held(free[j]) ? ridge[static_cast<Index>(j)] * v * v : 0;
  }
  return sum;
}

// Within what can be meant: where much is missing in a model, a body that nothing moves predicts
// better than its own, and a level that falls with no speed is a clip.
void bound(Parameters& p, const Context& c) {
  p[Key::kMass] = std::clamp(p[Key::kMass], c.mass_least_kg, c.mass_most_kg);
  const double most = c.input_max_N / std::max(1e-12, c.top_speed_m_per_s);
  p[Key::kViscous] = std::clamp(p[Key::kViscous], -most, most);
  p[Key::kCoulomb] = std::clamp(p[Key::kCoulomb], 0.0, c.input_max_N);
  p[Key::kStallSpeed] = std::min(p[Key::kStallSpeed], std::max(kFarSpeed * c.top_speed_m_per_s,
                                                               c.stated.no_load_speed_m_per_s));
}

Model moved(const Model& from, const Context& context, const std::vector<FreeParameter>& free,
            const VectorXd& by) {
  Model to = from;
  for (std::size_t j = 0; j < free.size(); ++j) {
    double& value = value_in(to, free[j]);
    const double wanted = value + by[static_cast<Index>(j)];
    value = free[j].positive && value > 0
                ? std::clamp(wanted, value / kLargestFactor, value * kLargestFactor)
                : wanted;
  }
  Parameters& p = to.parameters;
  bound(p, context);
  p[Key::kDelay] = std::max(0.0, p[Key::kDelay]);
  p[Key::kLag] = std::max(0.0, p[Key::kLag]);
  p[Key::kMotorMass] = std::min(p[Key::kMotorMass], 0.98 * p[Key::kMass]);
  p[Key::kLoadShare] = std::min(p[Key::kLoadShare], 1.0);
  return to;
}

// What a step has changed.
VectorXd step_of(Model from, Model to, const std::vector<FreeParameter>& free) {
  VectorXd by(std::ssize(free));
  for (std::size_t j = 0; j < free.size(); ++j) {
    by[static_cast<Index>(j)] = value_in(to, free[j]) - value_in(from, free[j]);
  }
  return by;
}

// [X e]'[X e] with e - X `by` in the place of e.
MatrixXd after_a_step(const MatrixXd& gram, const VectorXd& by) {
  MatrixXd to = MatrixXd::Identity(gram.rows(), gram.cols());
  to.topRightCorner(by.size(), 1) = -by;
  return to.transpose() * gram * to;
}

// Moves the mean of what each run has of its own into the model: no data tell one from the other,
// and a fit ends before the weak hold on the runs has done it. Dry friction stays above zero.
void centre(Model& model, Key key, double OfRun::*own) {
  double mean = 0;
  for (const OfRun& run : model.of_run) mean += run.*own / static_cast<double>(model.of_run.size());
  if (key == Key::kCoulomb) mean = std::max(mean, -model.parameters[key]);
  model.parameters[key] += mean;
  for (OfRun& run : model.of_run) run.*own -= mean;
}

}  // namespace

std::vector<FreeParameter> base_free_parameters(const Context& c, std::size_t runs) {
  const double force = 0.01 * c.input_rms_N;
  const double speed = std::max(1e-12, c.top_speed_m_per_s);
  std::vector<FreeParameter> free{
      {.key = Key::kMass, .step = 0.01 * c.stated.mass_kg, .positive = true},
      {.key = Key::kViscous, .step = force / speed},
      {.key = Key::kCoulomb, .step = force}};
  if (c.one_way == 0) free.push_back({.key = Key::kBias, .step = force});
  for (std::size_t run = 0; run < runs && runs > 1; ++run) {
    free.push_back({.of = FreeParameter::Of::kBiasOfRun, .run = run, .step = force});
    free.push_back({.of = FreeParameter::Of::kCoulombOfRun, .run = run, .step = force});
  }
  return free;
}

double& value_in(Model& model, const FreeParameter& f) {
  switch (f.of) {
    case FreeParameter::Of::kBiasOfRun:
      return model.of_run[f.run].bias_N;
    case FreeParameter::Of::kCoulombOfRun:
      return model.of_run[f.run].coulomb_N;
    case FreeParameter::Of::kTurnsOfRun:
      return model.of_run[f.run].turns[static_cast<std::size_t>(f.wave)];
    case FreeParameter::Of::kAll:
      break;
  }
  return model.parameters[f.key];
}

std::vector<Variation> varied(const Model& model, const std::vector<FreeParameter>& free) {
  std::vector<Variation> out;
  for (const FreeParameter& f : free) {
    Variation& v = out.emplace_back(Variation{model, f.step, {}});
    value_in(v.model, f) += f.step;
    if (f.of != FreeParameter::Of::kAll) v.run = f.run;
  }
  return out;
}

double runs_differ_N(const Context& c) {
  return kRunsDiffer * std::max(c.stated.coulomb_N, 0.2 * c.input_rms_N);
}

VectorXd ridge_of(const std::vector<FreeParameter>& free, const Context& c, double variance) {
  VectorXd ridge = VectorXd::Zero(std::ssize(free));
  const double usual = runs_differ_N(c);
  for (std::size_t j = 0; j < free.size(); ++j) {
    if (is_held(free[j])) {
      ridge[static_cast<Index>(j)] = variance / (usual * usual);
    }
  }
  return ridge;
}

Fitted fit_model(const Data& data, const Context& context, Model start,
                 const std::vector<FreeParameter>& free, double bandwidth,
                 const std::vector<Span>& spans, int rounds) {
  Fitted best{std::move(start), {}, 0};
  best.e = innovations(data, best.model, bandwidth);
  const VectorXd ridge = ridge_of(free, context, long_run_variance(spans, best.e));
  best.cost = weighted_square(spans, best.e) + penalty(free, ridge, best.model);
  const Index last = std::ssize(free);
  double damping = 1e-6;
  for (int round = 0; round < rounds; ++round) {
    MatrixXd a = MatrixXd::Zero(last, last);
    VectorXd b = VectorXd::Zero(last);
    std::vector<MatrixXd> grams =
        grams_of(data, best.e, varied(best.model, free), bandwidth, spans);
    for (const MatrixXd& gram : grams) {
      a += gram.topLeftCorner(last, last);
      b += gram.topRightCorner(last, 1);
    }
    for (std::size_t j = 0; j < free.size(); ++j) {
      const auto i = static_cast<Index>(j);
      a(i, i) += ridge[i];
      b[i] -= ridge[i] * (is_held(free[j]) ? value_in(best.model, free[j]) : 0);
    }
    const VectorXd scale = a.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const MatrixXd scaled = scale.asDiagonal() * a * scale.asDiagonal();
    const Model model_before = best.model;
    const double before = best.cost;
    for (int attempt = 0; attempt < 6; ++attempt, damping *= 20) {
      const MatrixXd damped = scaled + damping * MatrixXd::Identity(scaled.rows(), scaled.cols());
      const VectorXd by = scale.asDiagonal() * damped.ldlt().solve(scale.asDiagonal() * b);
      Fitted other{moved(best.model, context, free, by), {}, 0};
      other.e = innovations(data, other.model, bandwidth);
      other.cost = weighted_square(spans, other.e) + penalty(free, ridge, other.model);
      if (std::isfinite(other.cost) && other.cost < best.cost) {
        best = std::move(other);
        damping = std::max(1e-9, damping / 50);
        break;
      }
    }
    if (before - best.cost < kGoodEnough * before) {
      const VectorXd by = step_of(model_before, best.model, free);
      for (MatrixXd& gram : grams) gram = after_a_step(gram, by);
      best.grams = std::move(grams);
      break;
    }
  }
  if (std::any_of(free.begin(), free.end(), is_held)) {
    if (context.one_way == 0) centre(best.model, Key::kBias, &OfRun::bias_N);
    centre(best.model, Key::kCoulomb, &OfRun::coulomb_N);
  }
  return best;
}

double best_bandwidth(const Data& data, const Context& context, const Model& model,
                      double followed) {
  struct Tried {
    double bandwidth;
    double cost;
    Index said;  // samples of which something can be said
  };
  std::vector<Tried> tried;
  const double steps = std::pow(followed * context.resolution_m, 2);
  // A slow correction has a long memory, and leaves few blocks.
  const double slowest = std::max(6.0, 300 / context.duration_s);
  for (double w = slowest; w < kFastest_per_sample / context.period_s && w < 700; w *= 1.6) {
    tried.push_back({w, 0, 0});
  }
  in_parallel(tried.size(), [&](std::size_t i) {
    Tried& t = tried[i];
    const VectorXd e = innovations(data, model, t.bandwidth);
    std::vector<Span> spans = cut(data, t.bandwidth);
    weigh(data, spans, e);
    t.cost = std::max(weighted_square(spans, e) / (samples_in(spans, e) + 1), steps);
    t.said = (e.array() != 0).count();
  });
  if (tried.empty()) return kFastest_per_sample / context.period_s;
  // Behind a gap a slow one is silent for long.
  const auto most = static_cast<double>(tried.back().said);
  const auto better = [&](const Tried& a, const Tried& b) {
    const bool a_says = static_cast<double>(a.said) > kLeastSaid * most;
    const bool b_says = static_cast<double>(b.said) > kLeastSaid * most;
    return a_says != b_says ? a_says : a.cost < b.cost;
  };
  return std::min_element(tried.begin(), tried.end(), better)->bandwidth;
}

}  // namespace towbench::study::diagnose
