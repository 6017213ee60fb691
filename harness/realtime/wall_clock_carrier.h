// What a carrier is asked to bear in a run by the wall clock. A local socket bears every edge in
// each of the plant's ticks; a serial line and a bus bear a digest an exchange.
#pragma once

#include "core/time.h"
#include "protocol/carriers/carrier_address.h"
#include "protocol/carriers/connection.h"
#include "protocol/carriers/load.h"

namespace towbench::harness {

[[nodiscard]] constexpr bool bears_every_tick(protocol::Scheme scheme) noexcept {
  return scheme == protocol::Scheme::kLocal;
}

// How often the plant reports.
[[nodiscard]] constexpr core::Nanoseconds report_period_ns(protocol::Scheme scheme,
                                                           core::Nanoseconds exchange_ns) noexcept {
  return bears_every_tick(scheme) || exchange_ns <= 0 ? core::kPlantTick_ns : exchange_ns;
}

// Either end, before its first turn.
void go_by_the_wall_clock(protocol::Connection& connection) noexcept;

// Refused above 80 % of what the wire carries, with both figures (load.h). A bus without a rate of
// its own is taken for one of 1 Mbit/s.
[[nodiscard]] protocol::CarrierResult<void> bears_the_wall_clock(
    const protocol::CarrierAddress& address, core::Nanoseconds exchange_ns);
[[nodiscard]] protocol::CarrierResult<void> bears_by_the_wall_clock(
    const protocol::CarrierAddress& address, const protocol::Traffic& traffic);

}  // namespace towbench::harness
