#include "board/cycle_counter.h"

namespace towbench::board {
namespace {

constexpr unsigned kControlGroup = 12;
constexpr unsigned kCounterGroup = 13;
constexpr unsigned kUserGroup = 14;
constexpr std::uint32_t kEnable = 1U << 0U;
constexpr std::uint32_t kResetCycles = 1U << 2U;
constexpr std::uint32_t kDivide = 1U << 3U;
constexpr std::uint32_t kCycles = 1U << 31U;
constexpr core::Nanoseconds kDivider = 64;

}  // namespace

std::optional<MonitorAccess> monitor_access(std::uint32_t instruction) noexcept {
  // Condition or Thumb's 0b1110 | 1110 | opc1 = 0 | L | CRn = 9 | Rt | 15 | opc2 | 1 | CRm
  if ((instruction & 0x0FEF'0F10U) != 0x0E09'0F10U || instruction >> 28U == 0xFU) {
    return std::nullopt;
  }
  const unsigned group = instruction & 0xFU;
  if (group < kControlGroup || group > kUserGroup) {
    return std::nullopt;
  }
  return MonitorAccess{.reads = (instruction & 1U << 20U) != 0,
                       .target = instruction >> 12U & 0xFU,
                       .group = group,
                       .number = instruction >> 5U & 7U};
}

std::uint32_t CycleCounter::count(core::Nanoseconds now_ns) const noexcept {
  const auto passed = counts() ? (now_ns - since_ns_) / (divides_ ? kDivider : 1) : 0;
  return from_ + static_cast<std::uint32_t>(passed);
}

void CycleCounter::restart(std::uint32_t from, core::Nanoseconds now_ns) noexcept {
  from_ = from;
  since_ns_ = now_ns;
}

void CycleCounter::write(const MonitorAccess& access, std::uint32_t value,
                         core::Nanoseconds now_ns) noexcept {
  const bool controls = access.group == kControlGroup;
  const bool resets = controls && access.number == 0 && (value & kResetCycles) != 0;
  restart(is_count(access) ? value : resets ? 0 : count(now_ns), now_ns);
  if (controls && access.number == 0) {
    enabled_ = (value & kEnable) != 0;
    divides_ = (value & kDivide) != 0;
  } else if (controls && access.number == 1) {
    selected_ = selected_ || (value & kCycles) != 0;
  } else if (controls && access.number == 2) {
    selected_ = selected_ && (value & kCycles) == 0;
  }
}

std::string_view CycleCounter::not_modelled(const MonitorAccess& access) noexcept {
  constexpr unsigned kOverflow = 3;
  constexpr unsigned kEventCount = 2;
  if (access.reads && access.group == kControlGroup && access.number == kOverflow) {
    return "overflow flags";
  }
  if (access.reads && access.group == kCounterGroup && access.number == kEventCount) {
    return "an event counter";
  }
  return !access.reads && access.group == kUserGroup && access.number == 1 ? "an interrupt" : "";
}

}  // namespace towbench::board
