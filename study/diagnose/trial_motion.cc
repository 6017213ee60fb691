#include "study/diagnose/trial_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kTurn = 2 * std::numbers::pi;
// BBMC refuses longer ramps; a leg of which more than this is ramp shows no steady speed.
constexpr double kLongestRamp_s = 5;
constexpr double kMostRamp = 0.8;
// What a motion may ask of the drive: share of the no-load speed, and of the force limit for
// acceleration alone.
constexpr double kOfDrive = 0.6;
constexpr double kForceOfDrive = 0.2;

// Speed trapezoids of one speed and one acceleration between two points.
VectorXd to_and_fro(const TrialMotion& m, Index samples, double period_s) {
  VectorXd out(samples);
  double x = m.centre_m - m.amplitude_m;
  double v = 0;
  double target = 1;
  const double most = m.acceleration_m_per_s2 * period_s;
  for (double& position : out) {
    const double to_go = m.centre_m + target * m.amplitude_m - x;
    const double stop = v * v / (2 * m.acceleration_m_per_s2);
    const bool brakes = std::abs(to_go) <= stop || to_go * target <= 0;
    const double wish = brakes ? 0.0 : target * m.speed_m_per_s;
    v += std::clamp(wish - v, -most, most);
    x += v * period_s;
    if (std::abs(v) < 1e-9 && wish == 0) {
      target = -target;
    }
    position = x;
  }
  return out;
}

bool can_be_asked_for(const TrialMotion& m) {
  const double ramp_s = m.speed_m_per_s / m.acceleration_m_per_s2;
  return ramp_s <= kLongestRamp_s && ramp_s * m.speed_m_per_s <= kMostRamp * 2 * m.amplitude_m;
}

}  // namespace

std::string TrialMotion::words() const {
  if (kind == Kind::kSine) {
    return fmt::format("a sine of {:.3g} m at {:.3g} Hz", amplitude_m, frequency_Hz);
  }
  return fmt::format("to and fro over {:.3g} m at {:.3g} m/s, {:.3g} m/s2", 2 * amplitude_m,
                     speed_m_per_s, acceleration_m_per_s2);
}

VectorXd TrialMotion::positions_m(double duration_s, double period_s) const {
  const auto samples = static_cast<Index>(duration_s / period_s);
  if (kind == Kind::kToAndFro) {
    return to_and_fro(*this, samples, period_s);
  }
  VectorXd out(samples);
  for (Index i = 0; i < samples; ++i) {
    out[i] =
        centre_m - amplitude_m * std::cos(kTurn * frequency_Hz * static_cast<double>(i) * period_s);
  }
  return out;
}

std::vector<TrialMotion> motion_menu(const Context& c, double logged_m_per_s2) {
  const double centre = 0.5 * (2 * c.stroke_min_m + c.stroke_m);
  const double half = 0.5 * c.stroke_m;
  const double top_speed = std::max(c.top_speed_m_per_s, kOfDrive * c.stated.no_load_speed_m_per_s);
  const double top_acceleration = std::max(
      logged_m_per_s2, kForceOfDrive * c.stated.force_limit_N / std::max(1e-9, c.stated.mass_kg));
  std::vector<TrialMotion> motions;
  for (const double speed :
       {0.03 * c.top_speed_m_per_s, 0.1 * c.top_speed_m_per_s, 0.3 * c.top_speed_m_per_s,
        c.top_speed_m_per_s, 0.3 * top_speed, top_speed}) {
    for (const double acceleration : {0.1 * logged_m_per_s2, top_acceleration}) {
      const TrialMotion motion{.kind = TrialMotion::Kind::kToAndFro,
                               .centre_m = centre,
                               .amplitude_m = std::min(half, 1.5 * speed),
                               .speed_m_per_s = speed,
                               .acceleration_m_per_s2 = acceleration};
      if (can_be_asked_for(motion)) {
        motions.push_back(motion);
      }
    }
  }
  for (const double frequency : {0.3, 1.0, 3.0, 5.0}) {
    const double w = kTurn * frequency;
    const double amplitude = std::min({half, top_speed / w, top_acceleration / (w * w)});
    motions.push_back({.kind = TrialMotion::Kind::kSine,
                       .centre_m = centre,
                       .amplitude_m = amplitude,
                       .speed_m_per_s = amplitude * w,
                       .acceleration_m_per_s2 = amplitude * w * w,
                       .frequency_Hz = frequency});
  }
  return motions;
}

}  // namespace towbench::study::diagnose
