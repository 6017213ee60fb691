#include "harness/run/carrier_name.h"

#include "harness/run/run_carrier.h"

namespace towbench::harness {

std::string name_of_carrier(const RunOptions& options) {
  const auto& encoders = options.encoder_lines.controller;
  const auto lines = (options.lines.controller.empty() ? "" : " and " + options.lines.controller) +
                     (encoders.empty() ? "" : " and encoders on " + encoders);
  switch (options.carrier) {
    case Carrier::kInProcess:
      return options.external           ? options.external->text()
             : options.firmware.empty() ? "in-process"
                                        : "virtual board";
    case Carrier::kLocal:
      return "local" + lines;
    case Carrier::kSerialPty:
      return "serial-pty" + lines;
    case Carrier::kWire:
      break;
  }
  return options.wire->controller.text() + lines;
}

bool takes_edges(const RunOptions& options) {
  const auto kind = kind_of(options);
  const bool only_when_time_waits = kind == CarrierKind::kSerial || kind == CarrierKind::kCanFd;
  return kind != CarrierKind::kCan &&
         (!only_when_time_waits || options.clock == RunClock::kLockstep);
}

const char* fidelity_of(const RunOptions& options) {
  return !options.encoder_lines.controller.empty() ? "lines"
         : takes_edges(options)                    ? "edges"
                                                   : "digest";
}

}  // namespace towbench::harness
