// The cycle counter of the Cortex-A8's performance monitor (Cortex-A8 TRM 3.2.41 to 3.2.52): one
// cycle a nanosecond, as the board's time has it, or one in 64. Its event counters, overflow flags
// and interrupt are not modelled.
//
// Unicorn decodes the instructions that reach it, and its counter stands.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/time.h"

namespace towbench::board {

// MRC or MCR of CP15's performance monitor: p15, 0, Rt, c9, c12 to c14.
struct MonitorAccess {
  bool reads = false;
  unsigned target = 0;  // general register
  unsigned group = 0;   // CRm
  unsigned number = 0;  // opc2
};
// In the ARM's order: of Thumb code the first halfword is the upper one.
[[nodiscard]] std::optional<MonitorAccess> monitor_access(std::uint32_t instruction) noexcept;

class CycleCounter {
 public:
  void reset() noexcept { *this = {}; }
  void write(const MonitorAccess& access, std::uint32_t value, core::Nanoseconds now_ns) noexcept;
  [[nodiscard]] std::uint32_t count(core::Nanoseconds now_ns) const noexcept;

  [[nodiscard]] static bool is_count(const MonitorAccess& access) noexcept {
    return access.group == 13 && access.number == 0;
  }
  // What the access asks for that is not modelled; empty: nothing.
  [[nodiscard]] static std::string_view not_modelled(const MonitorAccess& access) noexcept;

 private:
  [[nodiscard]] bool counts() const noexcept { return enabled_ && selected_; }
  void restart(std::uint32_t from, core::Nanoseconds now_ns) noexcept;

  bool enabled_ = false;   // PMCR.E
  bool selected_ = false;  // PMCNTENSET bit 31
  bool divides_ = false;   // PMCR.D
  std::uint32_t from_ = 0;
  core::Nanoseconds since_ns_ = 0;
};

}  // namespace towbench::board
