// Where a side meets the other, as a user writes it:
//   local:PATH              a socket of this host, private to the user
//   serial:DEVICE[@BAUD]    a serial line, 921,600 baud unless said otherwise
//   can:INTERFACE           a CAN interface that is up; @fd: with FD frames, which carry edges
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/carriers/carrier_error.h"

namespace towbench::protocol {

enum class Scheme : std::uint8_t { kLocal, kSerial, kCan };

inline constexpr std::uint32_t kDefaultBaud = 921'600;
inline constexpr std::string_view kAddressForms =
    "local:PATH, serial:DEVICE[@BAUD] or can:INTERFACE[@fd]";

struct CarrierAddress {
  Scheme scheme = Scheme::kLocal;
  std::string place;                  // path, device or interface
  std::uint32_t baud = kDefaultBaud;  // of a serial line

  // As it would be written.
  [[nodiscard]] std::string text() const;
};

// Both ends, for a bench that starts both sides on this host:
//   serial:DEVICE,DEVICE[@BAUD]    two ports joined by a cable (or by socat)
//   can:INTERFACE[,INTERFACE]      one interface for both, or two on one bus; @fd, @BIT/S or
//                                  @BIT/S/BIT/S (paced_can.h) hold for both ends
struct CarrierEnds {
  CarrierAddress controller;
  CarrierAddress plant;
};

// Refused with kTransportFailed and a sentence that says what is allowed.
[[nodiscard]] CarrierResult<CarrierAddress> parse_carrier_address(std::string_view text);
[[nodiscard]] CarrierResult<CarrierEnds> parse_carrier_ends(std::string_view text);

}  // namespace towbench::protocol
