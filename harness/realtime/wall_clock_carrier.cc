#include "harness/realtime/wall_clock_carrier.h"

#include "protocol/carriers/paced_can.h"

namespace towbench::harness {

void go_by_the_wall_clock(protocol::Connection& connection) noexcept {
  if (auto* bus = connection.can_link(); bus != nullptr) {
    bus->go_by_the_wall_clock();
  }
}

protocol::CarrierResult<void> bears_the_wall_clock(const protocol::CarrierAddress& address,
                                                   core::Nanoseconds exchange_ns) {
  // A serial line's heartbeats are as long as lockstep's own messages.
  return bears_by_the_wall_clock(address, {.fidelity = protocol::Fidelity::kDigest,
                                           .lockstep = address.scheme == protocol::Scheme::kSerial,
                                           .exchange_ns = exchange_ns});
}

protocol::CarrierResult<void> bears_by_the_wall_clock(const protocol::CarrierAddress& address,
                                                      const protocol::Traffic& traffic) {
  using protocol::Scheme;
  switch (address.scheme) {
    case Scheme::kLocal:
      return {};
    case Scheme::kSerial:
      return protocol::accept_load(protocol::serial_load(traffic, address.baud), address.text());
    case Scheme::kCan:
      break;
  }
  constexpr std::uint32_t kFastestClassicCan = 1'000'000;
  const auto named = protocol::named_bus(address.place);
  const auto rate = named && named->bit_per_s > 0 ? named->bit_per_s : kFastestClassicCan;
  return protocol::accept_load(protocol::can_load(traffic, rate), address.text());
}

}  // namespace towbench::harness
