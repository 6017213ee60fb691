// The exact flow of a linear mode as a polynomial in time, to look inside a tick: where an event
// lies, and what the state is there.
//
//   z(s T) = sum_k c_k s^k,  c_0 = z(0),  c_{k+1} = T (A c_k + [k = 0] B u) / (k + 1),  0 <= s <= 1
//
// The number of terms is the mode's (linear_mode.cc): as exact as the tick's own matrices.
#pragma once

#include <array>

#include "core/realtime.h"
#include "emulator/plant/linear_mode.h"

namespace towbench::emulator {

// Coefficients of one scalar along the flow.
using ScalarSeries = std::array<double, kMaxTaylorTerms + 1>;

class TaylorFlow {
 public:
  TOWBENCH_REALTIME TaylorFlow(const ContinuousMode& mode, const StateVector& z,
                               const InputVector& u, double span_s) noexcept;

  [[nodiscard]] int terms() const noexcept { return terms_; }
  [[nodiscard]] const StateVector& coefficient(int k) const noexcept {
    return coefficients_[static_cast<std::size_t>(k)];
  }
  TOWBENCH_REALTIME [[nodiscard]] StateVector at(double fraction) const noexcept;

 private:
  int terms_;
  // Only [0, terms_] is ever written or read.
  std::array<StateVector, kMaxTaylorTerms + 1> coefficients_;
};

// First fraction in [0, last] where the series turns negative, given that it is negative at `last`
// and that the flow starts inside (a start below zero by rounding counts as inside).
TOWBENCH_REALTIME [[nodiscard]] double first_crossing(const ScalarSeries& series, int terms,
                                                      double last) noexcept;

}  // namespace towbench::emulator
