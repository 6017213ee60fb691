// The reference that an experiment states itself, for a controller that has no motions of its own
// or is not to be asked for one: along each axis one motion after the other, held before, between
// and behind them.
//
// Frame: metres from where the axis stands when the run begins, positive towards max.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/axis.h"
#include "core/time.h"

namespace towbench::harness {

struct ReferencePoint {
  double position_m = 0;
  double velocity_m_per_s = 0;
  double acceleration_m_per_s2 = 0;
};

class ReferenceTable;  // reference_table.h

enum class ReferenceKind : std::uint8_t {
  kTrapezoid,  // constant acceleration to the speed, and back to rest
  kSCurve,     // the same with an acceleration that rises and falls as half a sine
  kStep,       // at once
  kSine,       // distance_m sin(angle)
  kCircle,     // of both axes: y = radius (cos(angle) - 1), x = radius sin(angle)
  kSteps,      // a staircase: distance_m at once, `turns` times, period_s apart
  kHold,       // stays for period_s
  kTable,      // what a file says
};

// A day of virtual time: longer is a slip of the pen.
inline constexpr double kLongestRun_s = 86'400.0;

struct ReferenceMotion {
  ReferenceKind kind = ReferenceKind::kTrapezoid;
  core::Axis axis = core::kFirstAxis;  // of kCircle: none, it takes both
  double at_s = 0;
  double distance_m = 0;  // signed; of kSine the amplitude, of kCircle the radius
  double speed_m_per_s = 0;
  double acceleration_m_per_s2 = 0;  // the largest
  double period_s = 0;               // of kSine and kCircle, of each step, of kHold
  double turns = 1;
  bool in_radians = false;                        // of an axis that turns: read rad for m
  std::string file{};                             // of kTable, as the experiment names it
  std::shared_ptr<const ReferenceTable> table{};  // null until it has been read

  [[nodiscard]] double duration_s() const noexcept;
  [[nodiscard]] bool moves(core::Axis which) const noexcept {
    return kind == ReferenceKind::kCircle ? core::is_planar(which) : axis == which;
  }
  // Relative to where the axis stands when it begins; `time_s` since then, 0 .. duration.
  [[nodiscard]] ReferencePoint at(core::Axis which, double time_s) const noexcept;
};

class ReferenceSchedule {
 public:
  // In order of time, and none begins before the one before it on its axis has ended.
  explicit ReferenceSchedule(std::vector<ReferenceMotion> motions);

  [[nodiscard]] ReferencePoint at(core::Axis axis, core::Nanoseconds time_ns) const noexcept;
  // Whether a motion of the axis has begun.
  [[nodiscard]] bool begun(core::Axis axis, core::Nanoseconds time_ns) const noexcept;
  [[nodiscard]] core::Nanoseconds end_ns() const noexcept { return end_ns_; }

 private:
  std::vector<ReferenceMotion> motions_;
  core::Nanoseconds end_ns_ = 0;
};

}  // namespace towbench::harness
