// Open-loop duty as a pseudo-random binary sequence: +-duty with the flat spectrum that estimators
// want. Of maximum length, from a shift register with the feedback taps of a primitive polynomial;
// the same sequence every time.
#pragma once

#include <cstdint>

#include "core/realtime.h"
#include "core/result.h"
#include "core/time.h"

namespace towbench::bbmc {

struct PrbsParameters {
  double duty_pct = 10;      // signed, 0 < |duty| <= 100: of the first bit
  double bit_s = 0.05;       // time of one bit, > 0
  std::int32_t order = 7;    // 4 .. 11: the sequence has 2^order - 1 bits
  std::int32_t periods = 1;  // of the sequence, >= 1
  double wait_s = 0.5;       // >= 0
};

class PrbsProgram {
 public:
  // kRequestBadArgument for anything outside the bounds above, or longer than a day.
  [[nodiscard]] static core::Result<PrbsProgram> make(const PrbsParameters& wanted) noexcept;

  TOWBENCH_REALTIME [[nodiscard]] double duty_pct(double time_s) const noexcept;
  [[nodiscard]] double duration_s() const noexcept;
  [[nodiscard]] std::int64_t bits() const noexcept { return length_ * periods_; }

 private:
  double duty_pct_ = 0;
  core::Nanoseconds bit_ns_ = 1;
  core::Nanoseconds wait_ns_ = 0;
  std::int32_t order_ = 4;
  std::int64_t length_ = 15;
  std::int64_t periods_ = 0;
};

}  // namespace towbench::bbmc
