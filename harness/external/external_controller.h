// A controller that the bench did not write, in a process of its own.
#pragma once

#include <optional>
#include <string>

#include "protocol/carriers/carrier_address.h"

namespace towbench::harness {

struct ExternalController {
  // Started and ended by the bench: {address} in it is where the bench waits. Empty: somebody else
  // starts it, and it comes to `address`.
  std::string command{};
  std::optional<protocol::CarrierAddress> address{};

  // As it would be written.
  [[nodiscard]] std::string text() const {
    return address ? "external:" + address->text() : "process:" + command;
  }
};

}  // namespace towbench::harness
