#include "bbmc/baremetal/line_edges.h"

#include "bbmc/baremetal/am335x.h"
#include "bbmc/baremetal/board_pins.h"

namespace towbench::bbmc {
namespace {

using am335x::half;
using am335x::word;

constexpr std::uint32_t kTripForce = 0x30;
constexpr std::uint16_t kOneShot = 1U << 2U;

}  // namespace

InterruptsOff::InterruptsOff() noexcept : status_(0) {
  asm volatile("mrs %0, cpsr\n cpsid i" : "=r"(status_) : : "memory");
}

InterruptsOff::~InterruptsOff() {
  asm volatile("msr cpsr_c, %0" : : "r"(status_) : "memory");
}

bool LineEdges::before(const Aintc::Reading& a, const Aintc::Reading& b) noexcept {
  return a.time_ns != b.time_ns ? a.time_ns < b.time_ns
                                : interrupt_priority_of(a.line) < interrupt_priority_of(b.line);
}

void LineEdges::add(Line line, std::uint32_t levels, core::Nanoseconds now_ns) noexcept {
  const InterruptsOff off;
  std::uint32_t size = size_;
  if (size == kMost) {
    // The oldest edge that is not the kill switch's makes room: levels tell the rest.
    std::uint32_t victim = 0;
    while (victim + 1 < kMost && edges_[victim].line == Line::kKillSwitch) {
      ++victim;
    }
    for (std::uint32_t i = victim; i + 1 < kMost; ++i) {
      edges_[i] = edges_[i + 1];
    }
    size = kMost - 1;
  }
  edges_[size] = {.time_ns = now_ns, .line = line, .active = (levels & pin_mask(line)) != 0};
  size_ = size + 1;
}

void LineEdges::take_urgent(core::Nanoseconds now_ns) noexcept {
  const std::uint32_t levels = word(am335x::kGpioIn);
  if ((levels & pin_mask(Line::kKillSwitch)) != 0) {
    killed_ = true;
    half(am335x::pwm(core::Axis::kY) + kTripForce) = kOneShot;
    half(am335x::pwm(core::Axis::kX) + kTripForce) = kOneShot;
    word(am335x::kGpioClear) =
        pin_mask(Line::kAmplifierEnableY) | pin_mask(Line::kAmplifierEnableX);
  }
  const std::uint32_t raised = word(am335x::kGpioStatus0);
  word(am335x::kGpioStatus0) = raised;
  if ((raised & pin_mask(Line::kKillSwitch)) != 0) {
    add(Line::kKillSwitch, levels, now_ns);
  }
}

void LineEdges::take_others(core::Nanoseconds now_ns) noexcept {
  const std::uint32_t raised = word(am335x::kGpioStatus1);
  word(am335x::kGpioStatus1) = raised;
  const std::uint32_t levels = word(am335x::kGpioIn);
  for (std::size_t i = 0; i < kInputLines; ++i) {
    const Line line = static_cast<Line>(i);
    if ((raised & pin_mask(line)) != 0) {
      add(line, levels, now_ns);
    }
  }
}

}  // namespace towbench::bbmc
