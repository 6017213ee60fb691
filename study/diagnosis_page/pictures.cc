#include "study/diagnosis_page/pictures.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "study/prediction/units.h"

namespace towbench::study::diagnosis_page {
namespace {

using diagnose::Diagnosis;
using diagnose::Series;
using Eigen::Index;
using Eigen::VectorXd;
using procedures::Curve;
using procedures::Figure;
using procedures::Mark;

constexpr Index kMostPoints = 1500;  // of a curve: more cannot be told apart on a page
constexpr int kFrequencies = 240;

struct Coordinate {
  std::string name;
  std::string label;  // {0}: unit of length, {1}: of force
  VectorXd Series::*of;
};

const std::vector<Coordinate>& coordinates() {
  static const std::vector<Coordinate> kAll{
      {"speed", "speed, {0}/s", &Series::speed_m_per_s},
      {"position", "position, {0}", &Series::position_m},
      {"acceleration", "acceleration, {0}/s2", &Series::acceleration_m_per_s2},
      {"command", "force commanded, {1}", &Series::input_N},
      {"time", "time, s", &Series::time_s}};
  return kAll;
}

std::string labelled(const Diagnosis& d, const std::string& label) {
  const auto units = diagnose::units_of(d.context.stated);
  return fmt::format(fmt::runtime(label), units.length, units.force);
}

const VectorXd& along(const Diagnosis& d, VectorXd Series::*of) {
  return d.series.*of;
}

// Rows of the first run: time starts again with the next.
Index rows_of_first(const Diagnosis& d) {
  return d.series.starts[1];
}

// A line is broken where rows are left out.
Curve curve(std::string name, const VectorXd& x, const VectorXd& y, Index rows, Mark mark) {
  Curve out{.name = std::move(name), .mark = mark};
  const Index stride = std::max<Index>(1, rows / kMostPoints);
  const double next = rows > 1 ? (x.segment(1, rows - 1) - x.head(rows - 1)).minCoeff() : 0;
  for (Index i = 0; i < rows; i += stride) {
    if (mark == Mark::kLine && i > 0 &&
        x[i] - x[i - stride] > 1.5 * static_cast<double>(stride) * next) {
      out.x.push_back(x[i]);
      out.y.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    out.x.push_back(x[i]);
    out.y.push_back(y[i]);
  }
  return out;
}

Figure force_in_time(const Diagnosis& d) {
  const VectorXd t = along(d, &Series::time_s);
  const VectorXd& force = d.series.input_N;
  const Index rows = rows_of_first(d);
  return {
      .title = "Force, measured and modelled",
      .x_label = "time, s",
      .y_label = labelled(d, "force, {1}"),
      .curves = {curve("commanded", t, force, rows, Mark::kLine),
                 curve("model, refitted", t, force - d.series.refitted_N, rows, Mark::kLine),
                 curve("with what was found", t, force - d.series.extended_N, rows, Mark::kLine)},
      .caption = "Behind the low pass of the correction."};
}

Figure residual_along(const Diagnosis& d, const Coordinate& coordinate) {
  const VectorXd x = along(d, coordinate.of);
  const Index rows = coordinate.of == &Series::time_s ? rows_of_first(d) : x.size();
  return {.title = fmt::format("What is left, against {}", coordinate.name),
          .x_label = labelled(d, coordinate.label),
          .y_label = labelled(d, "residual, {1}"),
          .curves = {curve("model, refitted", x, d.series.refitted_N, rows, Mark::kDots),
                     curve("with what was found", x, d.series.extended_N, rows, Mark::kDots)},
          .caption = {}};
}

Curve amplitudes(std::string name, const VectorXd& t, const VectorXd& r, double highest_Hz) {
  Curve out{.name = std::move(name), .mark = Mark::kLine};
  const auto n = static_cast<double>(std::max<Index>(1, r.size()));
  for (int k = 1; k <= kFrequencies; ++k) {
    const double f = highest_Hz * k / kFrequencies;
    std::complex<double> sum = 0;
    for (Index i = 0; i < r.size(); ++i) {
      sum += std::polar(r[i], -2 * std::numbers::pi * f * t[i]);
    }
    out.x.push_back(f);
    out.y.push_back(2 * std::abs(sum) / n);
  }
  return out;
}

Figure spectrum(const Diagnosis& d) {
  const Index rows = rows_of_first(d);
  const VectorXd t = along(d, &Series::time_s).head(rows);
  const double highest = d.series.bandwidth / std::numbers::pi;
  return {.title = "What is left, by frequency",
          .x_label = "frequency, Hz",
          .y_label = labelled(d, "amplitude, {1}"),
          .curves = {amplitudes("model, refitted", t, d.series.refitted_N.head(rows), highest),
                     amplitudes("with what was found", t, d.series.extended_N.head(rows), highest)},
          .caption = "Of the first run."};
}

// Against the coordinate that tells most of it: the one in whose bins its means vary most.
std::size_t natural_coordinate(const std::vector<VectorXd>& along_all, const VectorXd& force) {
  constexpr int kBins = 24;
  std::size_t best = 0;
  double most = -1;
  for (std::size_t c = 0; c < along_all.size(); ++c) {
    const VectorXd& x = along_all[c];
    const double low = x.minCoeff();
    const double width = std::max(1e-300, x.maxCoeff() - low);
    std::vector<double> sum(kBins, 0.0);
    std::vector<double> count(kBins, 0.0);
    for (Index i = 0; i < x.size(); ++i) {
      const auto bin = static_cast<std::size_t>(
          std::clamp(static_cast<int>(kBins * (x[i] - low) / width), 0, kBins - 1));
      sum[bin] += force[i];
      count[bin] += 1;
    }
    double told = 0;
    for (std::size_t b = 0; b < sum.size(); ++b) {
      told += count[b] > 0 ? sum[b] * sum[b] / count[b] : 0;
    }
    if (told > most) {
      most = told;
      best = c;
    }
  }
  return best;
}

// What repeats along the way is seen over one period, folded; null: it does not.
std::optional<VectorXd> folded(const Diagnosis& d, const diagnose::NamedCause& cause) {
  const double per_m = cause.size("spatial_frequency_per_m");
  if (per_m == 0) {
    return std::nullopt;
  }
  const VectorXd periods = per_m * along(d, &Series::position_m);
  return periods.array() - periods.array().floor();
}

void add_causes(const Diagnosis& d, std::vector<Figure>& figures) {
  std::vector<VectorXd> all;
  for (const Coordinate& coordinate : coordinates()) {
    all.push_back(along(d, coordinate.of));
  }
  for (std::size_t i = 0; i < d.causes.size(); ++i) {
    const auto& cause = d.causes[i];
    const VectorXd force = d.series.by_cause_N.col(static_cast<Index>(i));
    const std::optional<VectorXd> period = folded(d, cause);
    const std::size_t c = natural_coordinate(all, force);
    const VectorXd& x = period ? *period : all[c];
    figures.push_back(
        {.title = fmt::format("What {} takes away", cause.effect->name),
         .x_label =
             period ? "position within a period, turns" : labelled(d, coordinates()[c].label),
         .y_label = labelled(d, "force, {1}"),
         .curves = {curve("what is left without it", x, d.series.extended_N + force, force.size(),
                          Mark::kDots),
                    curve("what it explains", x, force, force.size(), Mark::kDots)},
         .caption = fmt::format("{:.3g} {} rms: {}.",
                                force.norm() / std::sqrt(static_cast<double>(force.size())),
                                units_of(d.context.stated).force, cause.effect->cause)});
  }
}

}  // namespace

std::vector<Figure> pictures(const Diagnosis& d) {
  std::vector<Figure> figures{force_in_time(d)};
  add_causes(d, figures);
  for (const Coordinate& coordinate : coordinates()) {
    figures.push_back(residual_along(d, coordinate));
  }
  figures.push_back(spectrum(d));
  return figures;
}

}  // namespace towbench::study::diagnosis_page
