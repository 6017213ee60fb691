// --carrier of the verbs that are one side.
#pragma once

#include <string>

#include "harness/fixtures/fixture_error.h"
#include "protocol/carriers/carrier_address.h"

namespace towbench::harness {

// Throws FixtureError for what is no address of a carrier.
[[nodiscard]] inline protocol::CarrierAddress carrier_address(const std::string& option,
                                                              const std::string& text) {
  const auto address = protocol::parse_carrier_address(text);
  if (!address) {
    throw FixtureError({"command line", 0, option}, '"' + text + '"',
                       std::string(protocol::kAddressForms));
  }
  return *address;
}

}  // namespace towbench::harness
