// One linear mode of the axis: z' = A z + B u, and its exact step over a tick with u held,
// z(t + h) = Phi z(t) + Gamma u,  [Phi Gamma; 0 I] = exp(h [A B; 0 0]).
//
// Which body slides or sticks, whether a hard end pushes and how the winding is driven are
// discrete; given these the axis is linear, and the tick is exact however stiff the current loop is
// (its 64 us are below the tick).
#pragma once

#include <array>
#include <cstddef>

#include "core/realtime.h"
#include "emulator/plant/square_matrix.h"

namespace towbench::emulator {

// Index of a quantity in the state vector z.
enum StateIndex : std::size_t {
  kCurrent,        // A
  kIntegral,       // V, of the current loop
  kMotorSpeed,     // rad/s
  kCarriageSpeed,  // m/s
  kStretch,        // m, of the transmission: r theta - x
  kMotorAngle,     // rad
  kStateCount
};

// Index of a held input in u.
enum InputIndex : std::size_t {
  kElectricalInput,  // current set-point in A, or terminal voltage in V
  kMotorTorque,      // N m, everything on the motor that is not linear in z
  kCarriageForce,    // N, likewise on the carriage
  kInputCount
};

using StateVector = Column<kStateCount>;
using InputVector = std::array<double, kInputCount>;

struct ContinuousMode {
  SquareMatrix<kStateCount> state{};             // A
  std::array<StateVector, kInputCount> input{};  // B, by columns
  int taylor_terms = 0;  // that give a whole tick to full precision (linear_mode.cc)
};

struct DiscreteMode {
  alignas(16) SquareMatrix<kStateCount> state{};
  alignas(16) std::array<StateVector, kInputCount> input{};
};

inline constexpr int kMaxTaylorTerms = 72;

// Fills in `taylor_terms` and gives the tick. False when the mode is too fast for the tick:
// rounding in the series would show.
[[nodiscard]] bool discretise(ContinuousMode& mode, double tick_s, DiscreteMode& out) noexcept;

// z(t + h). The sum is a tree: in a row, every addition would wait for the one before.
[[nodiscard, gnu::always_inline]] inline StateVector step(const DiscreteMode& mode,
                                                          const StateVector& z,
                                                          const InputVector& u) noexcept {
  StateVector next{};
  for (std::size_t row = 0; row < kStateCount; ++row) {
    next[row] =
        ((mode.state[0][row] * z[0] + mode.state[1][row] * z[1]) +
         (mode.state[2][row] * z[2] + mode.state[3][row] * z[3])) +
        ((mode.state[4][row] * z[4] + mode.state[5][row] * z[5]) +
         (mode.input[0][row] * u[0] + (mode.input[1][row] * u[1] + mode.input[2][row] * u[2])));
  }
  return next;
}

// z(t + h) moved by what `change` of one input would have made of it.
TOWBENCH_REALTIME inline void add_input(const DiscreteMode& mode, InputIndex input, double change,
                                        StateVector& next) noexcept {
  for (std::size_t row = 0; row < kStateCount; ++row) {
    next[row] += mode.input[input][row] * change;
  }
}

}  // namespace towbench::emulator
