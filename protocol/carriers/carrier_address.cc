#include "protocol/carriers/carrier_address.h"

#include <array>
#include <charconv>
#include <utility>

#include "protocol/carriers/paced_can.h"

namespace towbench::protocol {
namespace {

constexpr std::array kSchemes{std::pair{Scheme::kLocal, std::string_view("local:")},
                              std::pair{Scheme::kSerial, std::string_view("serial:")},
                              std::pair{Scheme::kCan, std::string_view("can:")}};

tl::unexpected<CarrierError> refuse(std::string_view text, std::string_view allowed) {
  return carrier_failure(
      core::ErrorCode::kTransportFailed,
      '"' + std::string(text) + "\" is no carrier (allowed: " + std::string(allowed) + "[@BIT/S])");
}

// Takes "@BAUD" off the end of a serial address. False when a rate is none.
bool take_baud(CarrierAddress& address) {
  if (address.scheme == Scheme::kCan) {
    return named_bus(address.place).has_value();  // stays with its interface
  }
  const auto at = address.place.rfind('@');
  if (address.scheme != Scheme::kSerial || at == std::string::npos) {
    return true;
  }
  const char* begin = address.place.data() + at + 1;
  const char* end = address.place.data() + address.place.size();
  const auto number = std::from_chars(begin, end, address.baud);
  if (number.ec != std::errc() || number.ptr != end || address.baud == 0) {
    return false;
  }
  address.place.erase(at);
  return true;
}

}  // namespace

std::string CarrierAddress::text() const {
  std::string text;
  for (const auto& [its_scheme, name] : kSchemes) {
    text += its_scheme == scheme ? std::string(name) + place : "";
  }
  return scheme == Scheme::kSerial ? text + '@' + std::to_string(baud) : text;
}

CarrierResult<CarrierAddress> parse_carrier_address(std::string_view text) {
  for (const auto& [scheme, name] : kSchemes) {
    if (text.starts_with(name)) {
      CarrierAddress address{.scheme = scheme, .place = std::string(text.substr(name.size()))};
      if (!take_baud(address) || address.place.empty()) {
        break;
      }
      return address;
    }
  }
  return refuse(text, kAddressForms);
}

CarrierResult<CarrierEnds> parse_carrier_ends(std::string_view text) {
  constexpr std::string_view kAllowed = "serial:DEVICE,DEVICE[@BAUD] or can:INTERFACE[,INTERFACE]";
  const auto both = parse_carrier_address(text);
  if (!both || both->scheme == Scheme::kLocal) {
    return refuse(text, kAllowed);
  }
  CarrierEnds ends{*both, *both};
  const auto comma = both->place.find(',');
  if (comma != std::string::npos) {
    const auto rate = both->place.find('@', comma);  // of a bus: of both its ends
    ends.controller.place.erase(comma, rate == std::string::npos ? rate : rate - comma);
    ends.plant.place.erase(0, comma + 1);
  } else if (both->scheme == Scheme::kSerial) {
    return refuse(text, kAllowed);  // a line has two ends
  }
  return ends.controller.place.empty() || ends.plant.place.empty()
             ? CarrierResult<CarrierEnds>(refuse(text, kAllowed))
             : ends;
}

}  // namespace towbench::protocol
