// What moves the bodies of an axis between two steps, in no time.
#include <cmath>

#include "emulator/plant/axis_plant.h"
#include "emulator/plant/transitions.h"

namespace towbench::emulator {
namespace {

double direction_of(double speed) noexcept {
  return speed == 0 ? 0.0 : std::copysign(1.0, speed);
}

}  // namespace

double AxisPlant::skip_tooth(double by_m) noexcept {
  const AxisModel& model = *model_;
  if (model.parameters.elasticity.rigid) {
    return 0.0;
  }
  const double carriage_m = carriage_position_m(model, z_);
  const double by_rad = by_m / model.mechanics.metres_per_motor_rad;
  z_[kMotorAngle] -= by_rad;
  situation_.motor_anchor_rad -= by_rad;
  // What the stretch must be for the carriage to stay where it is, on a real wheel too.
  z_[kStretch] += carriage_position_m(model, z_) - carriage_m;
  half_change_ = {};
  settle(model, situation_, z_);
  enter_mode();
  return by_rad;
}

void AxisPlant::displace(double by_m, double by_m_per_s) noexcept {
  const AxisModel& model = *model_;
  const double r = model.mechanics.metres_per_motor_rad;
  z_[kMotorAngle] += by_m / r;
  situation_.motor_anchor_rad += by_m / r;
  situation_.carriage_anchor_m += by_m;
  z_[kMotorSpeed] += by_m_per_s / r;
  z_[kCarriageSpeed] += by_m_per_s;
  Regime& regime = situation_.regime;
  regime.motor_direction = direction_of(z_[kMotorSpeed]);
  if (!model.parameters.elasticity.rigid) {
    regime.carriage_direction = direction_of(z_[kCarriageSpeed]);
  }
  half_change_ = {};
  settle(model, situation_, z_);
  enter_mode();
}

}  // namespace towbench::emulator
