#include "study/identify/tow/extended_model.h"

#include <algorithm>
#include <cmath>

#include "study/identify/linear_algebra.h"
#include "study/identify/tow/paired_difference.h"
#include "study/identify/tow/steady_span.h"

namespace towbench::study::identify {
namespace {

struct Bin {
  double place_m = 0;
  double speed_m_per_s = 0;
  double force_N = 0;
};

// Means of stretches of `bin_m`; the last piece, if shorter than half of that, goes with none.
std::vector<Bin> bins_of(const Recording& tow, core::Axis axis, double scale, double settle_s,
                         double bin_m) {
  std::vector<Bin> bins;
  for (const auto& span : steady_spans(tow, axis, settle_s)) {
    const double speed = std::fabs(span.speed_m_per_s);
    const auto rows =
        std::max<std::size_t>(1, static_cast<std::size_t>(bin_m / (speed * tow.period_s)));
    const auto swing = static_cast<std::size_t>(std::lround(kSwing_s / tow.period_s));
    const std::span<const double> column = tow.axes[axis].duty_pct;
    const auto quiet = without_swing(column.subspan(span.first, span.rows()), swing);
    const std::size_t offset = span.first + swing - 1;
    for (std::size_t first = 0; first + rows <= quiet.size(); first += rows) {
      double duty = 0;
      double place = 0;
      for (std::size_t i = first; i < first + rows; ++i) {
        duty += quiet[i] / static_cast<double>(rows);
        place += tow.axes[axis].reference_m[offset + i] / static_cast<double>(rows);
      }
      bins.push_back({place, speed, span.direction() * scale * duty});
    }
  }
  return bins;
}

// (3.25)
double stribeck(double speed_m_per_s, double scale_m_per_s) {
  return std::exp(-std::pow(speed_m_per_s / scale_m_per_s, 2));
}

}  // namespace

// b, g (when there is one), then the levels.
Eigen::VectorXd ExtendedModel::row(double place_m, double speed_m_per_s) const {
  const Eigen::Index extra = settings_.stribeck_speed_m_per_s ? 1 : 0;
  Eigen::VectorXd row = Eigen::VectorXd::Zero(1 + extra + knots_);
  row(0) = speed_m_per_s;
  if (extra != 0) {
    row(1) = stribeck(speed_m_per_s, *settings_.stribeck_speed_m_per_s);
  }
  const double span_m = settings_.to_m - settings_.from_m;
  const double along =
      std::clamp((place_m - settings_.from_m) / span_m, 0.0, 1.0) * static_cast<double>(knots_ - 1);
  const auto left = std::min<Eigen::Index>(static_cast<Eigen::Index>(along), knots_ - 2);
  const double share = along - static_cast<double>(left);
  row(1 + extra + left) = 1.0 - share;
  row(1 + extra + left + 1) = share;
  return row;
}

std::optional<ExtendedModel> ExtendedModel::fit(std::span<const Recording> tows, core::Axis axis,
                                                double scale, double settle_s,
                                                const ExtendedModelSettings& settings) {
  std::vector<Bin> bins;
  for (const auto& tow : tows) {
    const auto more = bins_of(tow, axis, scale, settle_s, settings.bin_m);
    bins.insert(bins.end(), more.begin(), more.end());
  }
  ExtendedModel model;
  model.settings_ = settings;
  // A term that no bin feels cannot be told.
  constexpr double kFelt = 0.05;
  double felt = 0;
  for (const auto& bin : bins) {
    felt = std::max(felt, settings.stribeck_speed_m_per_s
                              ? stribeck(bin.speed_m_per_s, *settings.stribeck_speed_m_per_s)
                              : 0.0);
  }
  if (felt < kFelt) {
    model.settings_.stribeck_speed_m_per_s.reset();
  }
  model.knots_ = std::max<Eigen::Index>(
      2, 1 + static_cast<Eigen::Index>(
                 std::lround((settings.to_m - settings.from_m) / settings.knot_distance_m)));
  const auto unknowns = model.row(settings.from_m, 1.0).size();
  const auto rows = static_cast<Eigen::Index>(bins.size());
  if (settings.to_m <= settings.from_m || rows <= 2 * unknowns) {
    return std::nullopt;
  }
  Eigen::MatrixXd a(rows, unknowns);
  Eigen::VectorXd y(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto& bin = bins[static_cast<std::size_t>(i)];
    a.row(i) = model.row(bin.place_m, bin.speed_m_per_s).transpose();
    y(i) = bin.force_N;
  }
  auto solved = least_squares(a, y);
  if (solved.rank < unknowns) {
    return std::nullopt;
  }
  model.solution_ = std::move(solved.x);
  const double variance =
      (y - a * model.solution_).squaredNorm() / static_cast<double>(rows - unknowns);
  model.covariance_ = variance * inverse(a.transpose() * a);
  return model;
}

double ExtendedModel::friction_N(double place_m, double speed_m_per_s) const {
  return row(place_m, speed_m_per_s).dot(solution_);
}

double ExtendedModel::standard_error_N(std::span<const double> places_m,
                                       double speed_m_per_s) const {
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(solution_.size());
  for (const double place_m : places_m) {
    mean += row(place_m, speed_m_per_s) / static_cast<double>(places_m.size());
  }
  return std::sqrt(std::max(0.0, mean.dot(covariance_ * mean)));
}

std::vector<double> ExtendedModel::places_m() const {
  std::vector<double> places;
  for (Eigen::Index knot = 0; knot < knots_; ++knot) {
    places.push_back(settings_.from_m + (settings_.to_m - settings_.from_m) *
                                            static_cast<double>(knot) /
                                            static_cast<double>(knots_ - 1));
  }
  return places;
}

std::vector<double> ExtendedModel::levels_N() const {
  std::vector<double> levels;
  for (Eigen::Index knot = solution_.size() - knots_; knot < solution_.size(); ++knot) {
    levels.push_back(solution_(knot));
  }
  return levels;
}

std::optional<DragPoint> predicted_drag(const Recording& tow, core::Axis axis, double scale,
                                        const ExtendedModel& model, double settle_s) {
  // The model's friction, row by row, is taken off the duty, so that what depends on the place does
  // not widen the interval.
  const auto& log = tow.axes[axis];
  std::vector<double> rest(log.duty_pct.size());
  std::vector<double> places;
  constexpr std::size_t kEvery = 50;
  double speed = 0;
  for (const auto& span : steady_spans(tow, axis, settle_s)) {
    speed = std::fabs(span.speed_m_per_s);
    for (std::size_t i = span.first; i < span.last; ++i) {
      rest[i] =
          scale * log.duty_pct[i] - span.direction() * model.friction_N(log.reference_m[i], speed);
      if (i % kEvery == 0) {
        places.push_back(log.reference_m[i]);
      }
    }
  }
  auto point = both_ways(tow, rest, axis, 1.0, settle_s);
  if (point) {
    point->force_N.standard_error =
        std::hypot(point->force_N.standard_error, model.standard_error_N(places, speed));
  }
  return point;
}

}  // namespace towbench::study::identify
