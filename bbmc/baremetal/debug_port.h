// What a debugger reads from the running image without disturbing it: telemetry rows, events and
// whether the controller is idle. Two rings in memory; the image writes, the debugger reads and
// counts what it has taken. A full ring drops the new row and counts it.
#pragma once

#include <array>
#include <cstdint>

#include "bbmc/system/system_event.h"
#include "bbmc/system/telemetry_row.h"

namespace towbench::bbmc {

inline constexpr const char* kDebugPortSymbol = "bbmc_debug_port";

template <typename T, std::uint32_t kCapacity>
struct DebugRing {
  std::uint32_t written = 0;
  std::uint32_t taken = 0;  // the debugger's
  std::array<T, kCapacity> items{};

  // False when full.
  [[nodiscard]] bool push(const T& item) noexcept {
    if (written - taken >= kCapacity) {
      return false;
    }
    items[written % kCapacity] = item;
    written = written + 1;
    return true;
  }
};

struct DebugPort {
  static constexpr std::uint32_t kMagic = 0x4D42'4244;  // "DBBM"

  std::uint32_t magic = 0;
  std::uint32_t row_bytes = sizeof(TelemetryRow);
  std::uint32_t event_bytes = sizeof(SystemEvent);
  std::uint32_t idle = 0;
  std::uint32_t lost = 0;
  std::uint32_t late_services = 0;  // a service that began after the next one was due
  DebugRing<TelemetryRow, 256> rows;
  DebugRing<SystemEvent, 256> events;
};
// The same bytes on both sides of the probe.
static_assert(sizeof(TelemetryRow) == 128);
static_assert(sizeof(SystemEvent) == 24);

}  // namespace towbench::bbmc
