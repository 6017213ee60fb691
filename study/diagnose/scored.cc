#include "study/diagnose/scored.h"

#include <cmath>
#include <limits>

#include "study/diagnose/series.h"
#include "study/statistics/statistics.h"

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kErrors99 = 2.58;
constexpr double kCalibrated = 0.25;  // of a held-out run
constexpr int kTurnsTried = 24;       // phases

Interval interval_of(const VectorXd& before, const VectorXd& after, double errors) {
  const Comparison c = compare(before, after, errors);
  return {c.gain, c.low, c.high};
}

double rms_of(const VectorXd& squares, double samples) {
  return std::sqrt(squares.sum() / samples);
}

VectorXd squares_in(const VectorXd& e, const std::vector<Span>& spans) {
  VectorXd out(std::ssize(spans));
  for (std::size_t i = 0; i < spans.size(); ++i) {
    out[static_cast<Index>(i)] =
        e.segment(spans[i].from, spans[i].to - spans[i].from).squaredNorm();
  }
  return out;
}

Model as_supplied(const Search& search, std::size_t runs) {
  return {parameters_of(search.context.stated), std::vector<OfRun>(runs)};
}

// Of what is periodic, the phase at which the first quarter is predicted best.
void find_turns(const Data& data, std::size_t run, Model& model, double bandwidth) {
  const auto quarter = static_cast<Index>(
      kCalibrated * static_cast<double>(data.starts[run + 1] - data.starts[run]));
  for (const Key key : kFrequencies) {
    if (model.parameters[key] == 0) continue;
    double& turns = model.of_run[run].turns[static_cast<std::size_t>(*wave_of(key))];
    double best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kTurnsTried; ++i) {
      turns = static_cast<double>(i) / kTurnsTried;
      VectorXd e(quarter);
      Innovations(data, run, model.in_run(run), bandwidth).next(e);
      if (e.squaredNorm() < least) {
        least = e.squaredNorm();
        best = turns;
      }
    }
    turns = best;
  }
}

// What each run has of its own, from its first quarter.
Model calibrated(const Data& data, const Context& context, Parameters parameters,
                 double bandwidth) {
  Model model{parameters, std::vector<OfRun>(data.scenes.size())};
  for (std::size_t run = 0; run < data.scenes.size(); ++run) {
    find_turns(data, run, model, bandwidth);
    std::vector<FreeParameter> free;
    for (const FreeParameter& f : base_free_parameters(context, data.scenes.size() + 1)) {
      if (f.of != FreeParameter::Of::kAll && f.run == run) free.push_back(f);
    }
    const VectorXd e = innovations(data, model, bandwidth);
    MatrixXd all(data.samples(), std::ssize(free) + 1);
    all << columns_of(data, e, varied(model, free), bandwidth), e;
    const Index from = data.starts[run];
    const auto n = static_cast<double>(data.starts[run + 1] - from);
    const auto to = from + static_cast<Index>(kCalibrated * n);
    const double square = e.segment(from, to - from).squaredNorm() / std::max(1.0, kCalibrated * n);
    const Blocks blocks(all, {{from, to}}, ridge_of(free, context, square));
    const VectorXd by = blocks.fit({0, 1}).b;
    for (std::size_t j = 0; j < free.size(); ++j) {
      value_in(model, free[j]) += by[static_cast<Index>(j)];
    }
  }
  return model;
}

struct Sides {
  VectorXd supplied, before, after;  // squares, block by block
};

Scored scored(const Sides& sides, double to_force, double samples, double force_rms_N) {
  Scored s;
  s.supplied_rms_N = to_force * rms_of(sides.supplied, samples);
  s.before_rms_N = to_force * rms_of(sides.before, samples);
  s.after_rms_N = to_force * rms_of(sides.after, samples);
  s.force_rms_N = force_rms_N;
  s.gain95 = interval_of(sides.before, sides.after, statistics::kNormal95);
  s.gain99 = interval_of(sides.before, sides.after, kErrors99);
  s.over_supplied95 = interval_of(sides.supplied, sides.after, statistics::kNormal95);
  return s;
}

}  // namespace

Scored score_within(const Data& data, const Search& search) {
  const double mass = search.final.fitted.model.parameters[Key::kMass];
  const double w = force_bandwidth(search.context, mass);
  const Frame frame{&data, search.context, w, cut(data, w)};
  const VectorXd supplied =
      squares_in(innovations(data, as_supplied(search, data.scenes.size()), w), frame.spans);
  const State before = make_state(frame, {}, search.base.fitted.model);
  const State after = make_state(frame, search.final.accepted, search.final.fitted.model);
  Scored s = scored({supplied, before.loss, after.loss}, mass * w * w,
                    static_cast<double>(data.samples()), search.context.input_rms_N);
  s.same_session = true;
  return s;
}

Scored score_on(const std::vector<Run>& holdout, const Data& fitted, const Search& search) {
  const Data data = make_data_like(fitted, holdout, search.context.stated);
  const Model& extended = search.final.fitted.model;
  const double mass = extended.parameters[Key::kMass];
  const double w = force_bandwidth(search.context, mass);
  std::vector<Span> spans;
  for (const Span& span : cut(data, w)) {
    for (std::size_t run = 0; run < data.scenes.size(); ++run) {
      const Index from = data.starts[run];
      const Index n = data.starts[run + 1] - from;
      const bool here = span.from >= from && span.to <= from + n;
      if (here && span.from >= from + static_cast<Index>(kCalibrated * static_cast<double>(n))) {
        spans.push_back(span);
      }
    }
  }
  double samples = 0;
  for (const Span& span : spans) samples += static_cast<double>(span.to - span.from);
  const auto side = [&](const Parameters& p) {
    return squares_in(innovations(data, calibrated(data, search.context, p, w), w), spans);
  };
  const Sides sides{side(parameters_of(search.context.stated)),
                    side(search.base.fitted.model.parameters), side(extended.parameters)};
  Scored s =
      scored(sides, mass * w * w, samples, make_context(search.context.stated, data).input_rms_N);
  s.same_session = false;
  return s;
}

}  // namespace towbench::study::diagnose
