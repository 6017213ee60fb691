#include "harness/fault_plan/carrier_fit.h"

#include <array>

namespace towbench::harness {

std::string_view why_not_over(CarrierKind carrier, FaultKind fault) noexcept {
  const bool is_socket = carrier == CarrierKind::kLocal;
  const bool is_bus = carrier == CarrierKind::kCan || carrier == CarrierKind::kCanFd;
  switch (fault) {
    case FaultKind::kBaudMismatch:
      if (is_socket || is_bus) {
        return "needs a serial line: no other carrier has two ends with a baud rate each";
      }
      return {};
    case FaultKind::kBusOff:
      if (is_socket || carrier == CarrierKind::kSerial) {
        return "needs a CAN bus: there is none to leave";
      }
      return {};
    case FaultKind::kReorder:
      return is_bus ? "a bus does not reorder: a node's frames leave in "
                      "order, and all hear them at once"
                    : "";
    case FaultKind::kCorruptByte:
      return is_bus ? "a bus repeats what its own checksum finds damaged: "
                      "what is left is loss, or bus_off"
                    : "";
    case FaultKind::kPeerRestart:
      return is_socket ? "a socket ends with its process: there it is peer_killed" : "";
    case FaultKind::kKilledWhileLogging:
      return carrier == CarrierKind::kInProcess
                 ? "needs two processes: who is killed would take the plant along"
                 : "";
    default:
      return {};
  }
}

std::string_view why_not_by_hand(const FaultRow& row) noexcept {
  if (row.needs == FaultNeeds::kRecord) {
    return "strikes the record: only in a run that is made for it (--fault)";
  }
  return why_not_over(CarrierKind::kInProcess, row.kind);
}

std::string_view name_of(CarrierKind carrier) noexcept {
  constexpr std::array<std::string_view, 5> kNames{"in-process", "local socket", "serial line",
                                                   "CAN", "CAN FD"};
  return kNames[static_cast<std::size_t>(carrier)];
}

CarrierKind kind_of(protocol::Scheme scheme) noexcept {
  switch (scheme) {
    case protocol::Scheme::kSerial:
      return CarrierKind::kSerial;
    case protocol::Scheme::kCan:
      return CarrierKind::kCan;
    case protocol::Scheme::kLocal:
      break;
  }
  return CarrierKind::kLocal;
}

}  // namespace towbench::harness
