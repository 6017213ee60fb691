#include "harness/experiment/reference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/experiment/reference_table.h"

namespace towbench::harness {
namespace {

using std::numbers::pi;

// From rest to rest over `distance` (> 0): up to `speed`, on, and down again, with ramps that are
// each other's mirror. A smooth ramp has the speed of (1 - cos)/2, so that its acceleration, which
// is pi/2 of the mean in its middle, begins and ends at zero.
class Profile {
 public:
  Profile(double distance, double speed, double acceleration, bool smooth) : smooth_(smooth) {
    const double shape = smooth ? pi / 2 : 1.0;
    speed_ = std::min(speed, std::sqrt(distance * acceleration / shape));
    ramp_s_ = shape * speed_ / acceleration;
    cruise_s_ = std::max(0.0, distance / speed_ - ramp_s_);
    distance_ = distance;
  }

  [[nodiscard]] double duration_s() const { return 2 * ramp_s_ + cruise_s_; }

  [[nodiscard]] ReferencePoint at(double time_s) const {
    if (time_s >= duration_s()) {
      return {.position_m = distance_};
    }
    if (time_s < ramp_s_) {
      return ramp(time_s);
    }
    if (time_s < ramp_s_ + cruise_s_) {
      return {speed_ * (ramp_s_ / 2 + time_s - ramp_s_), speed_, 0};
    }
    const auto mirrored = ramp(duration_s() - time_s);
    return {distance_ - mirrored.position_m, mirrored.velocity_m_per_s,
            -mirrored.acceleration_m_per_s2};
  }

 private:
  [[nodiscard]] ReferencePoint ramp(double time_s) const {
    const double mean = speed_ / ramp_s_;
    if (!smooth_) {
      return {mean * time_s * time_s / 2, mean * time_s, mean};
    }
    const double angle = pi * time_s / ramp_s_;
    return {speed_ / 2 * (time_s - ramp_s_ / pi * std::sin(angle)),
            speed_ / 2 * (1 - std::cos(angle)), mean * pi / 2 * std::sin(angle)};
  }

  bool smooth_;
  double speed_ = 0;
  double ramp_s_ = 0;
  double cruise_s_ = 0;
  double distance_ = 0;
};

// The angle of a sine or a circle: it takes a quarter of a period to its full rate, so that nothing
// jumps but the acceleration.
Profile angle_of(const ReferenceMotion& motion) {
  const double rate = 2 * pi / motion.period_s;
  return {2 * pi * motion.turns, rate, rate / (motion.period_s / 4), true};
}

Profile way_of(const ReferenceMotion& motion) {
  return {std::fabs(motion.distance_m), motion.speed_m_per_s, motion.acceleration_m_per_s2,
          motion.kind == ReferenceKind::kSCurve};
}

// r sin(angle) and r (cos(angle) - 1) with their derivatives.
ReferencePoint on_circle(double radius, const ReferencePoint& angle, bool sine) {
  const double s = radius * std::sin(angle.position_m);
  const double c = radius * std::cos(angle.position_m);
  const double rate = angle.velocity_m_per_s;
  const double change = angle.acceleration_m_per_s2;
  return sine ? ReferencePoint{s, c * rate, c * change - s * rate * rate}
              : ReferencePoint{c - radius, -s * rate, -s * change - c * rate * rate};
}

// One that has just ended counts, whatever the last bit of a difference of times says.
double whole_periods(double time_s, double period_s) {
  constexpr double kOfALastBit = 1e-9;
  return std::floor(time_s / period_s + kOfALastBit);
}

}  // namespace

double ReferenceMotion::duration_s() const noexcept {
  switch (kind) {
    case ReferenceKind::kTrapezoid:
    case ReferenceKind::kSCurve:
      return way_of(*this).duration_s();
    case ReferenceKind::kSine:
    case ReferenceKind::kCircle:
      return angle_of(*this).duration_s();
    case ReferenceKind::kSteps:
      return turns * period_s;
    case ReferenceKind::kHold:
      return period_s;
    case ReferenceKind::kTable:
      return table ? table->duration_s() : 0;
    case ReferenceKind::kStep:
      break;
  }
  return 0;
}

ReferencePoint ReferenceMotion::at(core::Axis which, double time_s) const noexcept {
  switch (kind) {
    case ReferenceKind::kSine:
      return on_circle(distance_m, angle_of(*this).at(time_s), true);
    case ReferenceKind::kCircle:
      return on_circle(distance_m, angle_of(*this).at(time_s), which == core::Axis::kX);
    case ReferenceKind::kStep:
      return {.position_m = distance_m};
    case ReferenceKind::kSteps:
      return {.position_m = distance_m * std::min(turns, 1 + whole_periods(time_s, period_s))};
    case ReferenceKind::kHold:
      return {};
    case ReferenceKind::kTable:
      return table ? table->at(time_s) : ReferencePoint{};
    case ReferenceKind::kTrapezoid:
    case ReferenceKind::kSCurve:
      break;
  }
  const auto way = way_of(*this).at(time_s);
  const double sign = distance_m < 0 ? -1 : 1;
  return {sign * way.position_m, sign * way.velocity_m_per_s, sign * way.acceleration_m_per_s2};
}

ReferenceSchedule::ReferenceSchedule(std::vector<ReferenceMotion> motions)
    : motions_(std::move(motions)) {
  for (const auto& motion : motions_) {
    end_ns_ = std::max(end_ns_, core::nanoseconds(motion.at_s + motion.duration_s()));
  }
}

ReferencePoint ReferenceSchedule::at(core::Axis axis, core::Nanoseconds time_ns) const noexcept {
  const double time_s = core::seconds(time_ns);
  double start_m = 0;
  ReferencePoint point;
  for (const auto& motion : motions_) {
    if (motion.moves(axis) && motion.at_s <= time_s) {
      point = motion.at(axis, std::min(time_s - motion.at_s, motion.duration_s()));
      point.position_m += start_m;
      start_m = point.position_m;
    }
  }
  return point;
}

bool ReferenceSchedule::begun(core::Axis axis, core::Nanoseconds time_ns) const noexcept {
  return std::any_of(motions_.begin(), motions_.end(), [&](const ReferenceMotion& motion) {
    return motion.moves(axis) && motion.at_s <= core::seconds(time_ns);
  });
}

}  // namespace towbench::harness
