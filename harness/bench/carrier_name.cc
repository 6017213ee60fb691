#include "harness/bench/carrier_name.h"

namespace towbench::harness {

std::string name_of_carrier(const RunOptions& options) {
  const auto lines = options.lines.controller.empty() ? "" : " and " + options.lines.controller;
  switch (options.carrier) {
    case Carrier::kInProcess:
      return options.firmware.empty() ? "in-process" : "virtual board";
    case Carrier::kLocal:
      return "local" + lines;
    case Carrier::kSerialPty:
      return "serial-pty" + lines;
    case Carrier::kWire:
      break;
  }
  return options.wire->controller.text() + lines;
}

}  // namespace towbench::harness
