#include "study/prediction/predictor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "study/prediction/in_parallel.h"
#include "study/prediction/session_clock.h"
#include "study/statistics/statistics.h"

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Time constants of the correction after which its start is forgotten.
constexpr double kForgotten = 6;
constexpr double kFarthest = 1e6;  // strokes; a model that runs away is no model

double speed_from(const Run& run, Index k) {
  const Index reach =
      std::min<Index>(std::max<Index>(4, std::lround(0.01 / run.period_s)), run.size() - 1 - k);
  return reach == 0 ? 0
                    : (run.position_m[k + reach] - run.position_m[k]) /
                          (static_cast<double>(reach) * run.period_s);
}

// That 99 % of the samples stay below.
double top_speed_of(const std::vector<Run>& runs) {
  std::vector<double> speeds;
  for (const Run& run : runs) {
    const auto reach = std::max<Index>(1, std::lround(0.01 / run.period_s));
    for (Index i = reach; i + reach < run.size(); i += reach) {
      speeds.push_back(std::abs(run.position_m[i + reach] - run.position_m[i - reach]) /
                       (2 * static_cast<double>(reach) * run.period_s));
    }
  }
  return speeds.empty() ? 0 : statistics::quantile(std::move(speeds), 0.99);
}

// Zero where there is none.
double mean_temperature_K_of(const std::vector<Run>& runs) {
  double sum = 0;
  double samples = 0;
  for (const Run& run : runs) {
    sum += run.temperature_K.sum();
    samples += static_cast<double>(run.temperature_K.size());
  }
  return samples > 0 ? sum / samples : 0;
}

// Of one more run in the session of those that are fitted: its own session where no clock tells.
double start_like(const Data& fitted, const Run& run) {
  std::vector<const Run*> all{&run};
  for (const Scene& scene : fitted.scenes) all.push_back(scene.run);
  const std::vector<double> starts_s = starts_on_one_clock(all);
  return starts_s.empty() ? 0 : starts_s[0] - starts_s[1] + fitted.scenes[0].session_start_s;
}

}  // namespace

Data make_data(const std::vector<Run>& runs, const NominalModel& stated) {
  Data data;
  double low = runs.front().position_m[0];
  double high = low;
  double end_s = 0;
  double session_s = 0;
  std::vector<const Run*> all;
  for (const Run& run : runs) all.push_back(&run);
  const std::vector<double> by_clock_s = starts_on_one_clock(all);
  data.starts.push_back(0);
  for (const Run& run : runs) {
    low = std::min(low, run.position_m.minCoeff());
    high = std::max(high, run.position_m.maxCoeff());
    const double start_s = by_clock_s.empty() ? end_s : by_clock_s[data.scenes.size()];
    data.scenes.emplace_back(run, stated);
    data.scenes.back().session_start_s = start_s;
    end_s = start_s + run.period_s * static_cast<double>(run.size());
    session_s = std::max(session_s, end_s);
    data.starts.push_back(data.starts.back() + run.size());
  }
  const double top_speed = top_speed_of(runs);
  const double temperature_K = mean_temperature_K_of(runs);
  for (Scene& scene : data.scenes) {
    scene.top_speed_m_per_s = top_speed;
    scene.stroke_min_m = low;
    scene.stroke_max_m = high;
    scene.session_length_s = session_s;
    scene.mean_temperature_K = temperature_K;
  }
  return data;
}

Data make_data_like(const Data& fitted, const std::vector<Run>& runs, const NominalModel& stated) {
  Data data = make_data(runs, stated);
  for (Scene& scene : data.scenes) {
    scene.stroke_min_m = fitted.scenes.front().stroke_min_m;
    scene.stroke_max_m = fitted.scenes.front().stroke_max_m;
    scene.session_length_s = fitted.scenes.front().session_length_s;
    scene.top_speed_m_per_s = fitted.scenes.front().top_speed_m_per_s;
    scene.session_start_s = start_like(fitted, *scene.run);
    scene.mean_temperature_K = fitted.scenes.front().mean_temperature_K;
  }
  return data;
}

Innovations::Innovations(const Data& data, std::size_t run, const Parameters& parameters,
                         double bandwidth)
    : run_(*data.scenes[run].run),
      bandwidth_(bandwidth),
      forgotten_(static_cast<Index>(std::ceil(kForgotten / (bandwidth * run_.period_s)))),
      farthest_m_(kFarthest * (data.scenes[run].stroke_max_m - data.scenes[run].stroke_min_m)),
      correction_(correction_of(parameters, run_.period_s, bandwidth)),
      axis_(parameters, data.scenes[run]),
      silent_(forgotten_) {
  axis_.place(run_.position_m[0], speed_from(run_, 0));
}

void Innovations::next(Eigen::Ref<VectorXd> e) {
  for (Index i = 0; i < e.size(); ++i) {
    e[i] = ran_away_ ? farthest_m_ : at(next_);
    ++next_;
  }
}

double Innovations::at(Index k) {
  double e = 0;
  if (!run_.missing.empty() && run_.missing[static_cast<std::size_t>(k)] != 0) {
    silent_ = forgotten_;
    ++gap_;
  } else {
    // What was driven meanwhile is not known: behind a long gap it begins anew.
    if (static_cast<double>(gap_) * run_.period_s * bandwidth_ > 1) {
      axis_.place(run_.position_m[k], speed_from(run_, k));
    }
    gap_ = 0;
    const double off = run_.position_m[k] - axis_.reading_m();
    ran_away_ = !(std::abs(off) < farthest_m_);
    if (ran_away_) {
      return farthest_m_;
    }
    e = silent_ > 0 ? 0 : off;
    axis_.correct(correction_, off);
    --silent_;
  }
  axis_.step(k);
  return e;
}

VectorXd innovations_of(const Data& data, std::size_t run, const Parameters& parameters,
                        double bandwidth) {
  VectorXd e(data.scenes[run].run->size());
  Innovations(data, run, parameters, bandwidth).next(e);
  return e;
}

VectorXd innovations(const Data& data, const Model& model, double bandwidth) {
  VectorXd e(data.samples());
  in_parallel(data.scenes.size(), [&](std::size_t i) {
    e.segment(data.starts[i], data.scenes[i].run->size()) =
        innovations_of(data, i, model.in_run(i), bandwidth);
  });
  return e;
}

}  // namespace towbench::study::diagnose
