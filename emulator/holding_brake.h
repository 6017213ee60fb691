// A holding brake: closed while its coil is not energised. Dry friction with a spring,
// elastoplastic (Dahl without his exponent): it holds the load by the grip of load_grip.h up to its
// holding force and slips above it, where the anchor of the spring follows.
//
//   s = x - x_0, cut to |s| <= F_h / k by moving x_0        F = -clamp(k s + d v, +-F_h)
//   F_h = T_h n / R                                         of T_h at the motor shaft
//
// It acts on the load, as the grip does: a drive behind an elastic transmission can wind that up.
// Assumed: slipping force and holding force are one, and a coil that changes its mind before the
// delay is over starts anew.
#pragma once

#include <cstdint>

#include "core/realtime.h"
#include "emulator/faults/load_grip.h"
#include "emulator/plant/axis_plant.h"
#include "emulator/rig_parameters.h"

namespace towbench::emulator {

class HoldingBrake {
 public:
  // Closed, at a load at `carriage_m`.
  HoldingBrake(const BrakeParameters& parameters, const AxisParameters& axis,
               double carriage_m) noexcept;

  // Of one tick: the force on the load, from its state at the tick's start.
  TOWBENCH_REALTIME [[nodiscard]] double step(bool energised, const AxisState& state) noexcept {
    move_armature(energised, state.carriage_m);
    return closed_ && !lost_ ? force_N(state) : 0.0;
  }

  // Faults: its coil is dead; it does not hold.
  void stick(bool stuck) noexcept { stuck_ = stuck; }
  void lose(bool lost, double carriage_m) noexcept {
    lost_ = lost;
    anchor_m_ = carriage_m;
  }

  [[nodiscard]] bool closed() const noexcept { return closed_; }

 private:
  void move_armature(bool energised, double carriage_m) noexcept;
  [[nodiscard]] double force_N(const AxisState& state) noexcept;

  LoadGrip grip_;
  double holding_N_;
  std::int64_t engage_ticks_;
  std::int64_t release_ticks_;
  std::int64_t ticks_against_ = 0;  // the coil has been against what the armature does
  double anchor_m_;
  bool closed_ = true;
  bool stuck_ = false;
  bool lost_ = false;
};

}  // namespace towbench::emulator
