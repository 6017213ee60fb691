// Where the encoders' channels are, as a user writes it:
//   CHIP[+FIRST][:index][@EDGES/S]       lines of a GPIO chip from FIRST (0) on (edge_port.h)
//   sim:CHIP[+FIRST][:index][@EDGES/S]   the machine's side of a simulated chip (gpio-sim)
// @EDGES/S: what these lines are rated for, all together.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "protocol/carriers/carrier_error.h"
#include "protocol/carriers/edge_port.h"
#include "protocol/carriers/gpio_edges.h"

namespace towbench::protocol {

inline constexpr std::string_view kEncoderLineForms =
    "CHIP[+FIRST][:index][@EDGES/S], or sim:... for the machine";

struct EncoderAddress {
  bool is_simulated = false;
  EdgePlace place;
  double rated_edges_per_s = 0;  // 0: not told
};

// All refused with a sentence for the user.
[[nodiscard]] CarrierResult<EncoderAddress> parse_encoder_address(std::string_view text);
[[nodiscard]] CarrierResult<std::unique_ptr<EdgeReader>> open_edge_reader(
    const EncoderAddress& address);
[[nodiscard]] CarrierResult<std::unique_ptr<EdgeDriver>> open_edge_driver(
    const EncoderAddress& address);

}  // namespace towbench::protocol
