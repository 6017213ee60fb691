// Where the machine's lines are, as a user writes it:
//   CHIP[+FIRST][~MILLISECONDS]    lines FIRST (0) to FIRST + 8 of a GPIO chip: gpiochip0,
//                                  gpiochip1+16, gpiochip0~5: debounced for 5 ms
//   sim:CHIP[+FIRST]               the machine's side of a simulated chip (gpio-sim)
// A debounce lasts by the host's clock: by the wall clock only.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "protocol/carriers/carrier_error.h"
#include "protocol/carriers/gpio_lines.h"
#include "protocol/carriers/line_port.h"

namespace towbench::protocol {

inline constexpr std::string_view kLineForms =
    "CHIP[+FIRST][~MILLISECONDS], or sim:CHIP[+FIRST] for the machine";

[[nodiscard]] constexpr bool is_debounced(std::string_view address) noexcept {
  return address.find('~') != std::string_view::npos;
}

// Opens one side's end. Refused with a sentence for the user.
[[nodiscard]] CarrierResult<std::unique_ptr<LinePort>> open_lines(std::string_view address,
                                                                  LineSide side);

}  // namespace towbench::protocol
