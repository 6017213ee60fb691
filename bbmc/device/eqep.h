// eQEP: quadrature decoder with capture unit of one axis.
#pragma once

#include <cstdint>
#include <string_view>

#include "bbmc/device/driver.h"
#include "core/time.h"

namespace towbench::bbmc {

struct Eqep {
  static constexpr std::string_view kName = "eqep";

  struct Settings {
    // The counter runs 0 .. position_max and wraps (QPOSMAX).
    std::uint32_t position_max = 0xFFFF'FFFFU;
    // Clock of the capture timer: 100 MHz / 2^n in the AM335x.
    double capture_clock_Hz = 1.5625e6;
    friend bool operator==(const Settings&, const Settings&) = default;
  };
  struct Reading {
    core::Nanoseconds time_ns = 0;          // when the registers were latched
    std::uint32_t position = 0;             // QPOSCNT
    std::uint32_t capture_ticks = 0;        // QCPRD: between the last two edges; saturates at 65535
    std::uint32_t since_edge_ticks = 0;     // QCTMR: since the last edge; saturates at 65535
    bool capture_valid = false;             // no reversal and no overflow between those two edges
    bool forward = true;                    // direction of the last edge
    std::uint32_t edges = 0;                // A and B edges since start, modulo 2^32
    std::uint32_t illegal_transitions = 0;  // since start, modulo 2^32
    std::uint32_t index_pulses = 0;         // since start, modulo 2^32
    std::uint32_t index_position = 0;       // QPOSILAT: position at the last index pulse
    bool edges_known = true;  // false behind a narrow link: `edges` is |count change| at best
  };
  // Software load of the position counter.
  struct Command {
    std::uint32_t position = 0;
  };

  [[nodiscard]] static constexpr bool valid(const Settings& settings) noexcept {
    // Two turns of a coarse encoder: less could wrap within one sample.
    return settings.position_max >= 8191 && settings.capture_clock_Hz >= 1e3 &&
           settings.capture_clock_Hz <= 1e8;
  }
  [[nodiscard]] static constexpr bool valid(const Command& command,
                                            const Settings& settings) noexcept {
    return command.position <= settings.position_max;
  }
};

inline constexpr std::uint32_t kCaptureSaturation_ticks = 0xFFFFU;  // 16-bit timer

using EqepDriver = Driver<Eqep>;
using EqepPort = Port<Eqep>;

}  // namespace towbench::bbmc
