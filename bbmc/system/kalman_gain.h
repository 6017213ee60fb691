// Steady-state gain of a Kalman filter with one measured state, the first, by running the Riccati
// difference equation until it stands still:
//
//   P_k|k-1 = A P A^T + Q,   K = P c / (c^T P c + r),   P = (I - K c^T) P_k|k-1,   c = e_1
//
// For set-up, not for the control path: a few thousand steps of 4 N^3 products.
#pragma once

#include <array>
#include <cstddef>

namespace towbench::bbmc {

template <std::size_t N>
using SquareMatrix = std::array<std::array<double, N>, N>;

template <std::size_t N>
struct SteadyGain {
  std::array<double, N> gain{};  // of the innovation, for the estimate after the measurement
  bool settled = false;          // false: not within the steps allowed, or no numbers
};

template <std::size_t N>
[[nodiscard]] SteadyGain<N> steady_gain(const SquareMatrix<N>& transition,
                                        const SquareMatrix<N>& noise,
                                        double measurement_variance) noexcept {
  constexpr int kMostSteps = 200'000;
  constexpr double kStill = 1e-13;  // relative change of every gain in one step
  SquareMatrix<N> ahead = noise;    // P_k|k-1
  SteadyGain<N> steady;
  for (int step = 0; step < kMostSteps && !steady.settled; ++step) {
    const double innovation = ahead[0][0] + measurement_variance;
    bool still = step > 0;
    for (std::size_t i = 0; i < N; ++i) {
      const double gain = ahead[i][0] / innovation;
      const double change = gain - steady.gain[i];
      const double size = gain < 0 ? -gain : gain;
      still = still && change <= kStill * size && -change <= kStill * size;
      steady.gain[i] = gain;
    }
    steady.settled = still;
    SquareMatrix<N> after{};
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) {
        after[i][j] = ahead[i][j] - steady.gain[i] * ahead[0][j];
      }
    }
    SquareMatrix<N> moved{};
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) {
        for (std::size_t k = 0; k < N; ++k) {
          moved[i][j] += transition[i][k] * after[k][j];
        }
      }
    }
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = noise[i][j];
        for (std::size_t k = 0; k < N; ++k) {
          sum += moved[i][k] * transition[j][k];
        }
        ahead[i][j] = sum;
        ahead[j][i] = sum;
      }
    }
  }
  return steady;
}

}  // namespace towbench::bbmc
