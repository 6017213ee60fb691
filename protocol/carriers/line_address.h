// Where the machine's lines are, as a user writes it:
//   CHIP[+FIRST]        lines FIRST (0) to FIRST + 8 of a GPIO chip: gpiochip0, gpiochip1+16
//   sim:CHIP[+FIRST]    the machine's side of a simulated chip (gpio-sim)
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "protocol/carriers/carrier_error.h"
#include "protocol/carriers/gpio_lines.h"
#include "protocol/carriers/line_port.h"

namespace towbench::protocol {

inline constexpr std::string_view kLineForms = "CHIP[+FIRST], or sim:CHIP[+FIRST] for the machine";

// Opens one side's end. Refused with a sentence for the user.
[[nodiscard]] CarrierResult<std::unique_ptr<LinePort>> open_lines(std::string_view address,
                                                                  LineSide side);

}  // namespace towbench::protocol
