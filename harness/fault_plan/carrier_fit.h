// Which carrier can have which fault: a bus has no baud rate of its own to disagree about and keeps
// its order, a socket has nothing to leave.
#pragma once

#include <cstdint>
#include <string_view>

#include "harness/fault_plan/fault_catalogue.h"
#include "protocol/carriers/carrier_address.h"

namespace towbench::harness {

enum class CarrierKind : std::uint8_t { kInProcess, kLocal, kSerial, kCan, kCanFd };

// Why a fault cannot happen there, in one line; empty: it can.
[[nodiscard]] std::string_view why_not_over(CarrierKind carrier, FaultKind fault) noexcept;
// Why it cannot be done during a run in one process; empty: it can.
[[nodiscard]] std::string_view why_not_by_hand(const FaultRow& row) noexcept;
[[nodiscard]] std::string_view name_of(CarrierKind carrier) noexcept;
[[nodiscard]] CarrierKind kind_of(protocol::Scheme scheme) noexcept;

}  // namespace towbench::harness
