#include "study/diagnose/free_run.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/diagnose/series.h"
#include "study/prediction/axis.h"
#include "study/statistics/statistics.h"

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kFewest = 12;
constexpr double kStart_s = 0.02;  // whose line is the speed that a whole run begins with

// Squares of the distances at the ends of windows in which all is measured: the state at a start is
// the corrected one.
std::vector<double> windows_of(const Data& data, const Model& model, double bandwidth) {
  std::vector<double> squares;
  for (std::size_t i = 0; i < data.scenes.size(); ++i) {
    const Scene& scene = data.scenes[i];
    const Run& run = *scene.run;
    const auto length = static_cast<Index>(std::lround(kWindow_s / run.period_s));
    const auto between = std::max<Index>(1, std::lround(kBetweenStarts_s / run.period_s));
    const auto settled = static_cast<Index>(std::ceil(6 / (bandwidth * run.period_s)));
    const Parameters p = model.in_run(i);
    const Correction correction = correction_of(p, run.period_s, bandwidth);
    Axis axis(p, scene);
    axis.place(run.position_m[0], 0);
    for (Index k = 0; k + length < run.size(); ++k) {
      const double off = run.position_m[k] - axis.reading_m();
      axis.correct(correction, off);
      if (k >= settled && k % between == 0 && run.is_measured(k, k + length + 1)) {
        Axis free = axis;
        for (Index j = k; j < k + length; ++j) free.step(j);
        const double end = run.position_m[k + length] - free.reading_m();
        squares.push_back(end * end);
      }
      axis.step(k);
    }
  }
  return squares;
}

double whole(const Data& data, const Model& model) {
  std::size_t longest = 0;
  for (std::size_t i = 0; i < data.scenes.size(); ++i) {
    if (data.scenes[i].run->size() > data.scenes[longest].run->size()) longest = i;
  }
  const Scene& scene = data.scenes[longest];
  const Run& run = *scene.run;
  const auto reach = std::clamp<Index>(std::lround(kStart_s / run.period_s), 1, run.size() - 1);
  Axis axis(model.in_run(longest), scene);
  axis.place(run.position_m[0], (run.position_m[reach] - run.position_m[0]) /
                                    (static_cast<double>(reach) * run.period_s));
  double sum = 0;
  for (Index k = 0; k < run.size(); ++k) {
    const double off = run.position_m[k] - axis.reading_m();
    sum += off * off;
    axis.step(k);
  }
  return std::sqrt(sum / static_cast<double>(run.size()));
}

VectorXd blocks_of(const std::vector<double>& squares, Index in_block) {
  VectorXd out(std::ssize(squares) / in_block);
  for (Index i = 0; i < out.size(); ++i) {
    out[i] = 0;
    for (Index j = 0; j < in_block; ++j) {
      out[i] += squares[static_cast<std::size_t>(i * in_block + j)];
    }
  }
  return out;
}

double rms(const std::vector<double>& squares) {
  double sum = 0;
  for (const double s : squares) sum += s;
  return std::sqrt(sum / static_cast<double>(squares.size()));
}

}  // namespace

Windows compare_windows(const std::vector<double>& supplied, const std::vector<double>& extended,
                        Index in_block) {
  Windows out;
  if (std::ssize(supplied) < kFewest) return out;
  out.count = std::ssize(supplied);
  out.supplied_m = rms(supplied);
  out.extended_m = rms(extended);
  const Comparison gain =
      compare(blocks_of(supplied, in_block), blocks_of(extended, in_block), statistics::kNormal95);
  out.gain95 = {gain.gain, gain.low, gain.high};
  return out;
}

FreeRun run_free(const Data& data, const Search& search) {
  const Model supplied{parameters_of(search.context.stated),
                       std::vector<OfRun>(data.scenes.size())};
  const auto fits = [&](const Model& model) {
    return model.of_run.size() == data.scenes.size()
               ? model
               : Model{model.parameters, std::vector<OfRun>(data.scenes.size())};
  };
  const Model refitted = fits(search.base.fitted.model);
  const Model extended = fits(search.final.fitted.model);
  FreeRun out;
  const double w = force_bandwidth(search.context, extended.parameters[Key::kMass]);
  constexpr Index kOverlapping = 10;
  out.windows =
      compare_windows(windows_of(data, supplied, w), windows_of(data, extended, w), kOverlapping);
  if (out.windows.count > 0) out.refitted_m = rms(windows_of(data, refitted, w));
  out.whole_supplied_m = whole(data, supplied);
  out.whole_refitted_m = whole(data, refitted);
  out.whole_extended_m = whole(data, extended);
  return out;
}

}  // namespace towbench::study::diagnose
