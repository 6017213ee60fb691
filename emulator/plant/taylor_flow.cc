#include "emulator/plant/taylor_flow.h"

namespace towbench::emulator {
namespace {

struct ValueAndSlope {
  double value;
  double slope;
};

ValueAndSlope evaluate(const ScalarSeries& series, int terms, double s) noexcept {
  double value = 0;
  double slope = 0;
  for (int k = terms; k >= 0; --k) {
    slope = slope * s + value;
    value = value * s + series[static_cast<std::size_t>(k)];
  }
  return {value, slope};
}

// A fraction below `high` where the series is positive, or 0 when it never seems to be.
double positive_side(const ScalarSeries& series, int terms, double high) noexcept {
  if (series[0] > 0) {
    return 0;
  }
  constexpr int kHalvings = 24;
  double s = high;
  for (int i = 0; i < kHalvings; ++i) {
    s *= 0.5;
    if (evaluate(series, terms, s).value > 0) {
      return s;
    }
  }
  return 0;
}

}  // namespace

TaylorFlow::TaylorFlow(const ContinuousMode& mode, const StateVector& z, const InputVector& u,
                       double span_s) noexcept
    : terms_(mode.taylor_terms) {
  coefficients_[0] = z;
  for (int k = 0; k < terms_; ++k) {
    const StateVector& c = coefficients_[static_cast<std::size_t>(k)];
    StateVector rate{};
    for (std::size_t column = 0; column < kStateCount; ++column) {
      for (std::size_t row = 0; row < kStateCount; ++row) {
        rate[row] += mode.state[column][row] * c[column];
      }
    }
    if (k == 0) {
      for (std::size_t column = 0; column < kInputCount; ++column) {
        for (std::size_t row = 0; row < kStateCount; ++row) {
          rate[row] += mode.input[column][row] * u[column];
        }
      }
    }
    const double scale = span_s / (k + 1);
    for (std::size_t row = 0; row < kStateCount; ++row) {
      coefficients_[static_cast<std::size_t>(k) + 1][row] = scale * rate[row];
    }
  }
}

StateVector TaylorFlow::at(double fraction) const noexcept {
  StateVector z{};
  for (int k = terms_; k >= 0; --k) {
    const StateVector& c = coefficients_[static_cast<std::size_t>(k)];
    for (std::size_t row = 0; row < kStateCount; ++row) {
      z[row] = z[row] * fraction + c[row];
    }
  }
  return z;
}

double first_crossing(const ScalarSeries& series, int terms, double last) noexcept {
  double low = positive_side(series, terms, last);
  double high = last;
  if (low == 0 && !(series[0] > 0)) {
    return 0;  // leaves at once
  }
  // Newton, kept inside a bracket that bisection shrinks when Newton leaves it.
  double s = high;
  constexpr int kIterations = 60;
  constexpr double kPrecision = 1e-14;
  for (int i = 0; i < kIterations && high - low > kPrecision; ++i) {
    const auto [value, slope] = evaluate(series, terms, s);
    (value >= 0 ? low : high) = s;
    const double next = s - value / slope;
    const bool inside = next > low && next < high;  // false for NaN
    const double bisected = 0.5 * (low + high);
    const double step = (inside ? next : bisected) - s;
    s = inside ? next : bisected;
    if (inside && step < kPrecision && step > -kPrecision) {
      break;
    }
  }
  return s;
}

}  // namespace towbench::emulator
