// Dry friction level against speed and position, (3.31)/(3.34) without sign and viscous part:
//
//   level(v, x) = C + (S - C) f_s(|v| / v_s) + F_P(x),  f_s(y) = exp(-y^2) or 1 / (1 + y^2)
//
// At rest the level is S + F_P(x), the break-away force, so friction is continuous through
// break-away. No libm: the Gaussian is a table of Hermite cubics, good to h^4 max f'''' / 384 =
// 3e-8 of (S - C).
#pragma once

#include <array>
#include <cstddef>

#include "core/realtime.h"
#include "emulator/plant/derived_mechanics.h"

namespace towbench::emulator {

class StribeckCurve {
 public:
  explicit StribeckCurve(StribeckForm form) noexcept;

  // f_s at speed_ratio = |v| / v_s >= 0.
  [[nodiscard, gnu::always_inline]] double operator()(double speed_ratio) const noexcept {
    if (form_ == StribeckForm::kLorentz) {
      return 1.0 / (1.0 + speed_ratio * speed_ratio);
    }
    const double scaled = speed_ratio * kKnotsPerUnit;
    if (!(scaled < static_cast<double>(kIntervals))) {
      return 0.0;
    }
    const auto interval = static_cast<std::size_t>(scaled);
    const double s = scaled - static_cast<double>(interval);
    const auto& c = cubics_[interval];
    return c[0] + s * (c[1] + s * (c[2] + s * c[3]));
  }

  // Whether f_s is zero at this ratio and, for a whole tick around it, as good as zero.
  [[nodiscard]] bool has_faded(double speed_ratio) const noexcept {
    return form_ == StribeckForm::kGaussian && speed_ratio > kFaded;
  }

 private:
  static constexpr double kFaded = 6.0;  // exp(-36) = 2e-16
  static constexpr double kKnotsPerUnit = 32.0;
  static constexpr std::size_t kIntervals = 200;  // up to a ratio of 6.25
  StribeckForm form_;
  std::array<std::array<double, 4>, kIntervals> cubics_{};
};

// F_P(x): piecewise linear, constant outside the knots.
class PositionCurve {
 public:
  // One level a position; `scale` turns motor-side torque into this body's unit.
  PositionCurve(const PositionFriction::Table& position_m, const PositionFriction::Table& level,
                double scale) noexcept;

  [[nodiscard]] bool present() const noexcept { return present_; }
  // `interval` remembers where x was last: a carriage seldom changes it. Any value from 0 up that
  // this curve left there will do to start with.
  [[nodiscard, gnu::always_inline]] double operator()(double carriage_m,
                                                      std::size_t& interval) const noexcept {
    while (carriage_m >= pieces_[interval].end_m) {
      ++interval;
    }
    while (carriage_m < pieces_[interval].start_m) {
      --interval;
    }
    const Piece& piece = pieces_[interval];
    return piece.level + piece.slope_per_m * (carriage_m - piece.reference_m);
  }

 private:
  struct Piece {
    double start_m;
    double end_m;
    double reference_m;  // where `level` holds; finite, as start_m of the first piece is not
    double level;
    double slope_per_m;
  };
  void add(double start_m, double end_m, double reference_m, double level,
           double slope_per_m) noexcept;

  bool present_;
  std::size_t count_ = 0;
  std::array<Piece, 33> pieces_{};  // a table of 32 knots has 31 intervals and two ends
};

}  // namespace towbench::emulator
