// The axis once more, written from the equations of docs/theory/plant.md for accuracy alone: the
// full nonlinear ODE, integrated by an adaptive Dormand-Prince 5(4) with dense output, every event
// located on it.
//
// Shares no code with emulator/plant but the parameter struct. Slow, and meant to be.
#pragma once

#include <array>
#include <cstddef>

#include "emulator/plant/axis_parameters.h"

namespace towbench::tests {

class AxisOracle {
 public:
  // [0] A, [1] V integrator, [2] rad, [3] rad/s, [4] m, [5] m/s, [6] warmth
  using State = std::array<double, 7>;

  struct Input {
    double command_V = 0;
    double supply_V = 12;
    double force_N = 0;
    bool enabled = true;
  };

  // `tolerance` is absolute and relative, on states scaled to be of order one.
  AxisOracle(const emulator::AxisParameters& parameters, double carriage_m, double tolerance);

  void advance(const Input& input, double duration_s);
  // The same by CVODE (BDF, its own root finder).
  void advance_by_cvode(const Input& input, double duration_s);

  [[nodiscard]] const State& state() const { return y_; }
  [[nodiscard]] double motor_counts() const;     // 4000 a turn
  [[nodiscard]] double carriage_counts() const;  // the same scale, by (3.42)
  [[nodiscard]] long events() const { return events_; }

  static constexpr std::size_t kMargins = 10;
  using Margins = std::array<double, kMargins>;
  void derivative(const State& y, State& rate) const;
  [[nodiscard]] Margins margins(const State& y) const;

 private:
  enum class Drive { kLoop, kSaturated, kVoltage, kCurrentHeld, kDiodes, kOpen };
  enum class End { kFree, kTouching, kLeaving };
  enum class Play { kTaut, kHalf, kGap, kParting };

  void begin(const Input& input);
  void settle_rest();
  void handle(std::size_t margin);
  [[nodiscard]] double terminal_V(const State& y) const;
  [[nodiscard]] double stretch_m(const State& y) const;
  [[nodiscard]] double lever_m(const State& y) const;
  [[nodiscard]] double strands_N(const State& y, Play play) const;
  [[nodiscard]] double transmission_N(const State& y) const;
  [[nodiscard]] double outside_N(const State& y) const;
  void transmission_margins(const State& y, Margins& m) const;
  void handle_transmission(std::size_t margin);
  [[nodiscard]] double end_N(const State& y) const;
  [[nodiscard]] double push_N(const State& y) const;
  // At the motor, a share of the axis's, in one direction.
  [[nodiscard]] double friction_Nm(const State& y, double share, int direction,
                                   double speed_rad_per_s) const;
  [[nodiscard]] double motor_limit_Nm(const State& y, int direction) const;
  [[nodiscard]] double carriage_limit_N(const State& y, int direction) const;
  [[nodiscard]] double motor_load_Nm(const State& y) const;
  [[nodiscard]] double carriage_load_N(const State& y) const;
  [[nodiscard]] double motor_grip_Nm(const State& y) const;
  [[nodiscard]] double carriage_grip_N(const State& y) const;

  emulator::AxisParameters p_;
  double tolerance_;
  double r_, jm_, mass_, bm_, bc_, ks_, bs_, kp_, ki_, share_;
  double half_gap_m_ = 0;
  double motor_spring_ = 0, motor_damper_ = 0, carriage_spring_ = 0, carriage_damper_ = 0;
  double motor_anchor_ = 0, carriage_anchor_ = 0;
  Input in_;
  double set_point_A_ = 0, limit_V_ = 0;
  Drive drive_ = Drive::kOpen;
  int drive_sign_ = 1;
  int motor_ = 0, carriage_ = 0;  // direction of sliding, 0: sticks
  Play play_ = Play::kTaut;
  int side_ = 0;
  End end_ = End::kFree;
  int end_sign_ = 1;
  State y_{};
  long events_ = 0;
};

}  // namespace towbench::tests
