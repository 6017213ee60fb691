// The rigid model (8.2) with what its friction lacks:
//
//   f = b x' + c(x) sgn(x') + g f_s(|x'| / v_s) sgn(x')
//
// c(x) piecewise linear between evenly spaced places (7.1: "position dependence included"), f_s the
// Stribeck curve (3.25) where its speed has been identified. Linear in b, the levels of c and g, so
// ordinary least squares over short stretches of steady tows out of the water; both directions are
// averaged, so a force that does not reverse with the motion (tilt, cable) stays out of it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "study/identify/recording.h"
#include "study/identify/tow/drag_law.h"

namespace towbench::study::identify {

struct ExtendedModelSettings {
  double from_m = 0;  // of the places, reference frame
  double to_m = 0;
  double knot_distance_m = 0.15;
  double bin_m = 0.05;                             // stretch that makes one equation
  std::optional<double> stribeck_speed_m_per_s{};  // none: no such term
};

class ExtendedModel {
 public:
  // Empty when the tows do not reach over the places or are too few to tell the terms apart.
  [[nodiscard]] static std::optional<ExtendedModel> fit(std::span<const Recording> tows,
                                                        core::Axis axis, double scale,
                                                        double settle_s,
                                                        const ExtendedModelSettings& settings);

  // Against the motion, N; speed > 0.
  [[nodiscard]] double friction_N(double place_m, double speed_m_per_s) const;
  // Its standard error for the mean over many places at one speed.
  [[nodiscard]] double standard_error_N(std::span<const double> places_m,
                                        double speed_m_per_s) const;
  // c at the knots.
  [[nodiscard]] std::vector<double> places_m() const;
  [[nodiscard]] std::vector<double> levels_N() const;
  [[nodiscard]] double viscous_N_s_per_m() const { return solution_(0); }

 private:
  ExtendedModel() = default;
  [[nodiscard]] Eigen::VectorXd row(double place_m, double speed_m_per_s) const;

  ExtendedModelSettings settings_;
  Eigen::Index knots_ = 0;
  Eigen::VectorXd solution_;
  Eigen::MatrixXd covariance_;
};

// (8.6) with this model in place of the rigid one.
[[nodiscard]] std::optional<DragPoint> predicted_drag(const Recording& tow, core::Axis axis,
                                                      double scale, const ExtendedModel& model,
                                                      double settle_s);

}  // namespace towbench::study::identify
