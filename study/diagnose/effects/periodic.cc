// What repeats with the turn of a shaft, with a tooth, or with time.
#include <cmath>
#include <numbers>

#include "study/diagnose/effect.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;

constexpr double kTurn = 2 * std::numbers::pi;

double motor_turns_per_m(const Context& c) {
  return c.model.metres_per_motor_rad > 0 ? 1 / (kTurn * c.model.metres_per_motor_rad) : 0;
}

// Whether a sufficiently slow part of the motion lets it through the filter.
bool is_visible(const Context& c, double per_m) {
  return per_m * 0.1 * c.top_speed_m_per_s < c.cutoff_Hz &&
         (c.resolution_m <= 0 || per_m * c.resolution_m < 0.2);
}

// Harmonics of the motor's turn; a drive without one is searched.
std::vector<Scales> ripple_grid(const Context& c) {
  std::vector<Scales> grid;
  for (const double harmonic : {1.0, 2.0, 3.0, 4.0, 6.0, 12.0}) {
    const double per_m = harmonic * motor_turns_per_m(c);
    if (per_m > 0 && is_visible(c, per_m)) {
      grid.push_back({per_m});
    }
  }
  return grid;
}

std::vector<Scales> motor_turn(const Context& c) {
  const double per_m = motor_turns_per_m(c);
  return per_m > 0 && is_visible(c, per_m) ? std::vector<Scales>{{per_m}} : std::vector<Scales>{};
}

std::vector<Scales> sprocket_turn(const Context& c) {
  if (c.model.sprocket_radius_m <= 0) {
    return {};
  }
  const double per_m = 1 / (kTurn * c.model.sprocket_radius_m);
  // Of less than that a cosine is a slope, and the turn is the position's own.
  const bool seen = (c.stroke_max_m - c.stroke_min_m) * per_m > 0.4;
  return seen ? std::vector<Scales>{{per_m}} : std::vector<Scales>{};
}

// Teeth of the sprocket are not in the model: usual numbers.
std::vector<Scales> tooth_grid(const Context& c) {
  std::vector<Scales> grid;
  if (c.model.sprocket_radius_m > 0) {
    for (int teeth = 10; teeth <= 40; ++teeth) {
      const double per_m = teeth / (kTurn * c.model.sprocket_radius_m);
      if (is_visible(c, per_m)) {
        grid.push_back({per_m});
      }
    }
  }
  return grid;
}

MatrixXd pair(const ArrayXd& phase, const ArrayXd& amplitude) {
  MatrixXd columns(phase.size(), 2);
  columns.col(0) = amplitude * phase.cos();
  columns.col(1) = amplitude * phase.sin();
  return columns;
}

MatrixXd torque_ripple(const Signals& s, const Context& /*c*/, std::span<const double> per_m) {
  return pair(kTurn * per_m[0] * s.position_m.array(), ArrayXd::Ones(s.size()));
}

// The radius varies over a turn, and with it the force that the same torque makes.
MatrixXd sprocket_eccentricity(const Signals& s, const Context& c, std::span<const double> per_m) {
  return pair(kTurn * per_m[0] * s.position_m.array(), c.model_force_N(s).array());
}

// The chain runs on a polygon: the carriage follows x = q + e sin(k q), so M x'' differs by
// M e (a k cos(k q) - v^2 k^2 sin(k q)). The eccentric encoder disk does the same to the measured
// q.
MatrixXd kinematic(const Signals& s, const Context& c, std::span<const double> per_m) {
  const double k = kTurn * per_m[0];
  const ArrayXd phase = k * s.position_m.array();
  const ArrayXd a = c.theta[kMass] * k * s.acceleration_m_per_s2.array();
  const ArrayXd v2 = c.theta[kMass] * k * k * s.speed_m_per_s.array().square();
  MatrixXd columns(s.size(), 2);
  columns.col(0) = a * phase.cos() - v2 * phase.sin();
  columns.col(1) = -a * phase.sin() - v2 * phase.cos();
  return columns;
}

MatrixXd periodic_force(const Signals& s, const Context& /*c*/, std::span<const double> hertz) {
  return pair(kTurn * hertz[0] * s.time_s.array(), ArrayXd::Ones(s.size()));
}

std::vector<Scales> nothing(const Context& /*c*/) {
  return {};
}

}  // namespace

void add_periodic_effects(Library& library) {
  library.push_back({.name = "torque_ripple",
                     .cause = "a force repeating with the motor's turn (cogging, commutation)",
                     .coefficients = {"cosine_N", "sine_N"},
                     .scales = {"spatial_frequency_per_m"},
                     .differs_between_sessions = true,
                     .search = LineSearch::kPosition,
                     .needs = "slow motion, so that a turn takes longer than the filter's period",
                     .grid = ripple_grid,
                     .columns = torque_ripple});
  library.push_back({.name = "sprocket_eccentricity",
                     .cause = "a sprocket that runs out of round",
                     .coefficients = {"cosine_ratio", "sine_ratio"},
                     .scales = {"spatial_frequency_per_m"},
                     .differs_between_sessions = true,
                     .needs = "travel over at least one sprocket turn",
                     .grid = sprocket_turn,
                     .columns = sprocket_eccentricity});
  library.push_back({.name = "chain_polygon",
                     .cause = "the chain's polygon on its sprocket",
                     .coefficients = {"cosine_m", "sine_m"},
                     .scales = {"spatial_frequency_per_m"},
                     .differs_between_sessions = true,
                     .needs = "medium speed, where a tooth passes within the filter's band",
                     .grid = tooth_grid,
                     .columns = kinematic});
  library.push_back({.name = "encoder_eccentricity",
                     .cause = "an encoder disk that runs out of centre",
                     .coefficients = {"cosine_m", "sine_m"},
                     .scales = {"spatial_frequency_per_m"},
                     .differs_between_sessions = true,
                     .needs = "a turn of the motor within the filter's band, at two speeds",
                     .grid = motor_turn,
                     .columns = kinematic});
  library.push_back({.name = "periodic_force",
                     .cause = "a force that repeats in time, whatever the motion",
                     .coefficients = {"cosine_N", "sine_N"},
                     .scales = {"frequency_Hz"},
                     .differs_between_sessions = true,
                     .search = LineSearch::kTime,
                     .needs = "several periods of it",
                     .grid = nothing,
                     .columns = periodic_force});
}

}  // namespace towbench::harness::diagnose
