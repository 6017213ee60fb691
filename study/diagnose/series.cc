#include "study/diagnose/series.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "study/diagnose/motion.h"
#include "study/prediction/in_parallel.h"

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kWidest_Hz = 20;
constexpr double kNoiseShare = 1.0 / 30;
constexpr double kOfStep = 0.29;  // of a step, rms of rounding to it
constexpr Index kMostPictured = 60'000;

// The causes of a model switched off one after the other.
Model without(const Model& model, const Effect& effect, const Parameters& stated) {
  Model rest = model;
  for (const Key key : effect.amplitudes) rest.parameters[key] = stated[key];
  if (effect.amplitudes.empty()) {
    for (const Key key : {Key::kMotorMass, Key::kPlay, Key::kStiffness, Key::kDamping}) {
      rest.parameters[key] = stated[key];
    }
  }
  return rest;
}

}  // namespace

double force_bandwidth(const Context& c, double mass_kg) {
  const double widest = 2 * std::numbers::pi * kWidest_Hz;
  const double noise = std::max(1e-300, mass_kg * kOfStep * c.resolution_m);
  const double by_noise = std::sqrt(kNoiseShare * c.input_rms_N / noise);
  return std::clamp(by_noise, std::min(6.0, widest), std::min(widest, 0.25 / c.period_s));
}

Series make_series(const Data& data, const Search& search) {
  const Model& extended = search.final.fitted.model;
  const double mass = extended.parameters[Key::kMass];
  Series s;
  s.bandwidth = force_bandwidth(search.context, mass);
  const double to_force = mass * s.bandwidth * s.bandwidth;
  const Index every = std::max<Index>(1, data.samples() / kMostPictured);
  std::vector<Index> rows;
  s.starts.push_back(0);
  for (std::size_t run = 0; run < data.scenes.size(); ++run) {
    for (Index i = data.starts[run]; i < data.starts[run + 1]; i += every) rows.push_back(i);
    s.starts.push_back(std::ssize(rows));
  }
  const auto taken = [&](const VectorXd& all) -> VectorXd { return all(rows); };
  VectorXd t(data.samples()), v(data.samples()), a(data.samples()), q(data.samples()),
      u(data.samples());
  for (std::size_t run = 0; run < data.scenes.size(); ++run) {
    const Motion m = motion_of(*data.scenes[run].run, kSmooth_s);
    const Index n = m.time_s.size();
    t.segment(data.starts[run], n) = m.time_s;
    q.segment(data.starts[run], n) = m.position_m;
    v.segment(data.starts[run], n) = m.speed_m_per_s;
    a.segment(data.starts[run], n) = m.acceleration_m_per_s2;
    u.segment(data.starts[run], n) = m.input_N;
  }
  s.time_s = taken(t);
  s.position_m = taken(q);
  s.speed_m_per_s = taken(v);
  s.acceleration_m_per_s2 = taken(a);
  s.input_N = taken(u);
  // Negative: what the drive must make beyond the model.
  const auto lacks = [&](const Model& model) -> VectorXd {
    return -to_force * taken(innovations(data, model, s.bandwidth));
  };
  s.refitted_N = lacks(search.base.fitted.model);
  s.extended_N = lacks(extended);
  const Parameters stated = parameters_of(search.context.stated);
  s.by_cause_N.resize(std::ssize(rows), std::ssize(search.causes));
  in_parallel(search.causes.size(), [&](std::size_t i) {
    s.by_cause_N.col(static_cast<Index>(i)) =
        lacks(without(extended, *search.causes[i].effect, stated)) - s.extended_N;
  });
  return s;
}

}  // namespace towbench::study::diagnose
