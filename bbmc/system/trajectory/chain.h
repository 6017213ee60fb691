// Segments one after the other: way-points, or whatever a planner strings together.
//
// Thesis 4.3.1 gives each segment its own t_init and theta_0 for this; here a segment keeps its own
// time and the chain knows when each begins.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <variant>

#include "bbmc/system/trajectory/harmonic.h"
#include "bbmc/system/trajectory/hold.h"
#include "bbmc/system/trajectory/reference.h"
#include "bbmc/system/trajectory/s_curve.h"
#include "bbmc/system/trajectory/trapezoid.h"
#include "core/realtime.h"
#include "core/result.h"

namespace towbench::bbmc {

using Segment = std::variant<Hold, Trapezoid, SCurve, Harmonic>;

inline constexpr std::size_t kMaxSegments = 12;

class Chain {
 public:
  // One to kMaxSegments segments, each beginning where and as fast as the one before it ends
  // (to 1 nm and 1 nm/s); kRequestBadArgument otherwise.
  [[nodiscard]] static core::Result<Chain> make(std::span<const Segment> segments) noexcept;

  // Time from the start of the first segment; rests before it and after the last one.
  TOWBENCH_REALTIME [[nodiscard]] Reference at(double time_s) const noexcept;
  [[nodiscard]] double duration_s() const noexcept { return ends_s_[size_ - 1]; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

 private:
  std::array<Segment, kMaxSegments> segments_{};
  std::array<double, kMaxSegments> ends_s_{};
  std::size_t size_ = 1;
};

}  // namespace towbench::bbmc
