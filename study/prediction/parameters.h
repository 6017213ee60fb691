// Every quantity of the axis that a prediction can use, by key. Load side, SI; for a joint read rad
// for m and Nm for N. Zero switches a term off.
//
//   M v' = D(u) - B v - b - [forces by place, speed, time] - dry friction,  (3.33) and
//   (3.39)-(3.41)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace towbench::study::diagnose {

inline constexpr int kOthers = 5;  // axes beside this one
inline constexpr int kOtherKeys = 10;

enum class Key : std::uint8_t {
  kMass,     // kg, of everything that moves
  kViscous,  // N s/m
  kCoulomb,  // N
  kBias,     // N
  // Friction that resists: added to kCoulomb, never below zero.
  kCoulombAsymmetry,  // N, half the difference of the directions
  kLoadFriction,      // of the drive's force
  kStribeck,          // N at zero speed, (3.25)
  kStribeckSpeed,     // m/s
  kRolloff,           // N missing at zero speed
  kRolloffSpeed,      // m/s
  kBreakaway,         // N, beyond what slides, while the axis stands or leaves
  kBreakawaySpeed,    // m/s
  kPresliding,        // N missing right after a reversal: half of it follows the way (bristles.h)
  kPreslidingTravel,  // m
  kPreslidingTime,    // s, of the bristles' damping
  kPlaceFriction1,    // N, cos(k pi x) over the stroke, (3.34)
  kPlaceFriction2,
  kPlaceFriction3,
  kPlaceFriction4,
  kPlaceFriction5,
  kPlaceFriction6,
  kWarming,             // N that friction has fallen by at the end
  kWarmingTime,         // s
  kTemperatureDry,      // N that friction is lower a kelvin above the mean
  kTemperatureViscous,  // N s/m, the same of viscous friction
  kWorkWarming,         // of friction, its fall at top speed for ever: what it dissipates warms it
  kWorkWarmingTime,     // s
  // Forces that act whatever the direction, and drag.
  kViscousAsymmetry,  // N s/m
  kDrag,              // N s2/m2, (3.7)
  kCubic,             // N s3/m3
  kPlaceViscous1,     // N s/m, the same shapes
  kPlaceViscous2,
  kPlaceViscous3,
  kPlaceViscous4,
  kPlaceViscous5,
  kPlaceViscous6,
  kPlaceForce1,  // N
  kPlaceForce2,
  kPlaceForce3,
  kPlaceForce4,
  kPlaceForce5,
  kPlaceForce6,
  kCable,          // N/m from the middle of the stroke
  kGravityCosine,  // Nm, of a joint: cos q
  kGravitySine,    // Nm: sin q
  kRippleCosine,   // N
  kRippleSine,
  kRipplePerMetre,
  kPeriodicCosine,  // N
  kPeriodicSine,
  kPeriodicHertz,
  // Of each other axis in the log, kOtherKeys (other_axes.h).
  kOther,
  kOtherLast = kOther + kOthers * kOtherKeys - 1,
  // Drive: from the logged input to the force.
  kGainLoss,          // of the drive's force
  kDelay,             // s
  kLag,               // s
  kDeadband,          // N
  kClipShare,         // of what exceeds the level: 1 is a clip
  kClipLevel,         // N
  kStallShare,        // the same with a level that speed lowers
  kStallLevel,        // N at standstill
  kStallSpeed,        // m/s at which none is left
  kOutOfRoundCosine,  // of the drive's force
  kOutOfRoundSine,
  kOutOfRoundPerMetre,
  // A wheel out of round: the load goes (1 + these) times as far.
  kWheelCosine,
  kWheelSine,
  kWheelPerMetre,
  kWheelDry,  // of dry friction, what is behind the wheel
  // Two bodies; kMotorMass zero: rigid.
  kMotorMass,  // kg, of kMass
  kStiffness,  // N/m
  kDamping,    // N s/m
  kPlay,       // m from flank to flank
  kLoadShare,  // of Coulomb and viscous friction
  // Sensor: reads q + these.
  kCountLoss,   // of all counts
  kReadCosine,  // m
  kReadSine,
  kReadPerMetre,
  // Phases of what is periodic, in turns; a run's own.
  kRippleTurns,
  kPeriodicTurns,
  kOutOfRoundTurns,
  kReadTurns,
  kWheelTurns,
  kCount
};

// Of the damping that bristles have before they bend, what Prandtl's element has that loses as much
// to it from one reversal to sliding: the mean of 1 - |z| over its way.
inline constexpr double kPrandtlDamping = std::numbers::ln2;

inline constexpr int kShapes = 6;  // of each kPlace...
inline constexpr std::size_t kKeys = static_cast<std::size_t>(Key::kCount);

class Parameters {
 public:
  [[nodiscard]] double operator[](Key key) const noexcept {
    return values_[static_cast<std::size_t>(key)];
  }
  double& operator[](Key key) noexcept { return values_[static_cast<std::size_t>(key)]; }

 private:
  std::array<double, kKeys> values_{};
};

// `first` and those that follow it in the list.
[[nodiscard]] constexpr Key next(Key first, int by) noexcept {
  return static_cast<Key>(static_cast<int>(first) + by);
}

}  // namespace towbench::study::diagnose
