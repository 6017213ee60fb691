#include "harness/run/run_carrier.h"

#include "harness/fixtures/fixture_error.h"
#include "protocol/carriers/paced_can.h"

namespace towbench::harness {

void choose_carrier(const std::string& text, RunOptions& options) {
  if (text.empty() || text == "in-process") {
    options.carrier = Carrier::kInProcess;
  } else if (text == "local") {
    options.carrier = Carrier::kLocal;
  } else if (text == "serial-pty") {
    options.carrier = Carrier::kSerialPty;
  } else if (const auto ends = protocol::parse_carrier_ends(text)) {
    options.carrier = Carrier::kWire;
    options.wire = *ends;
  } else {
    throw FixtureError({"command line", 0, "--carrier"}, '"' + text + '"',
                       "in-process, local, serial-pty, serial:DEVICE,DEVICE[@BAUD] or "
                       "can:INTERFACE[,INTERFACE][@BIT/S[/BIT/S] or @fd]");
  }
}

CarrierKind kind_of(const RunOptions& options) noexcept {
  switch (options.carrier) {
    case Carrier::kInProcess:
      return CarrierKind::kInProcess;
    case Carrier::kLocal:
      return CarrierKind::kLocal;
    case Carrier::kSerialPty:
      return CarrierKind::kSerial;
    case Carrier::kWire:
      break;
  }
  const auto& address = options.wire->controller;
  const bool is_fd =
      address.scheme == protocol::Scheme::kCan && protocol::named_bus(address.place)->is_fd;
  return is_fd ? CarrierKind::kCanFd : kind_of(address.scheme);
}

}  // namespace towbench::harness
