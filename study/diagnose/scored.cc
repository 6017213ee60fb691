#include "study/diagnose/scored.h"

#include <cmath>

#include "study/diagnose/own_values.h"
#include "study/diagnose/series.h"
#include "study/statistics/statistics.h"

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kErrors99 = 2.58;
constexpr double kCalibrated = 0.25;  // of a held-out run

Interval interval_of(const VectorXd& before, const VectorXd& after, double errors) {
  const Comparison c = compare(before, after, errors);
  return {c.gain, c.low, c.high};
}

double rms_of(const VectorXd& squares, double samples) {
  return std::sqrt(squares.sum() / samples);
}

Model as_supplied(const Search& search, std::size_t runs) {
  return {parameters_of(search.context.stated), std::vector<OfRun>(runs)};
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
      squares_of(innovations(data, as_supplied(search, data.scenes.size()), w), frame.spans);
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
    return squares_of(
        innovations(data, with_own_values(data, search.context, p, kCalibrated, w), w), spans);
  };
  const Sides sides{side(parameters_of(search.context.stated)),
                    side(search.base.fitted.model.parameters), side(extended.parameters)};
  Scored s =
      scored(sides, mass * w * w, samples, make_context(search.context.stated, data).input_rms_N);
  s.same_session = false;
  return s;
}

}  // namespace towbench::study::diagnose
