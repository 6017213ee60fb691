// What crosses the two lock-free queues around the control path: samples in, drive commands out.
// Device I/O lives on the other side of both.
#pragma once

#include <cstdint>

#include "bbmc/device/aintc.h"
#include "bbmc/device/axes.h"
#include "bbmc/device/eqep.h"
#include "bbmc/device/gpio.h"
#include "core/spsc_queue.h"
#include "core/time.h"

namespace towbench::bbmc {

// Line edges in the order in which they are to be served; those that do not fit stay pending in the
// interrupt controller.
using LineEdgeQueue = core::SpscQueue<Aintc::Reading, 64>;

struct ControlSample {
  core::Nanoseconds time_ns = 0;
  PerAxis<Eqep::Reading> encoder;
  std::uint16_t lines = 0;            // levels, bit index_of(line)
  bool tick_due = false;              // a control tick is to be computed
  std::uint32_t ticks_missed = 0;     // that came and went before this one
  core::Nanoseconds tick_due_ns = 0;  // when it should have been
};

[[nodiscard]] constexpr std::uint16_t mask_of(Line line) noexcept {
  return static_cast<std::uint16_t>(1U << index_of(line));
}

struct AxisDrive {
  std::int32_t ticks = 0;  // signed: + drives towards max
  bool enable = false;
  friend bool operator==(const AxisDrive&, const AxisDrive&) = default;
};

struct DriveCommand {
  PerAxis<AxisDrive> axes;
  bool tick = false;  // belongs to a control tick: written even when nothing changed
};

}  // namespace towbench::bbmc
