#include "protocol/carriers/line_address.h"

#include <charconv>

#include "protocol/carriers/sim_lines.h"

namespace towbench::protocol {

CarrierResult<std::unique_ptr<LinePort>> open_lines(std::string_view address, LineSide side) {
  constexpr std::string_view kSimulated = "sim:";
  const bool is_simulated = address.starts_with(kSimulated);
  const auto place_text = address.substr(is_simulated ? kSimulated.size() : 0);
  const auto plus = place_text.find('+');
  GpioPlace place{.chip = std::string(place_text.substr(0, plus))};
  bool is_good = !place.chip.empty() && !(is_simulated && side == LineSide::kController);
  if (plus != std::string_view::npos) {
    const auto digits = place_text.substr(plus + 1);
    const auto* end = digits.data() + digits.size();
    const auto number = std::from_chars(digits.data(), end, place.first_line);
    is_good = is_good && number.ec == std::errc() && number.ptr == end;
  }
  if (!is_good) {
    return carrier_failure(core::ErrorCode::kTransportFailed,
                           '"' + std::string(address) + "\" is no place of lines (allowed: " +
                               std::string(kLineForms) + ")");
  }
  if (is_simulated) {
    auto lines = SimLines::open(place.chip, place.first_line);
    return lines ? CarrierResult<std::unique_ptr<LinePort>>(std::move(*lines))
                 : tl::unexpected<CarrierError>(lines.error());
  }
  auto lines = GpioLines::open(place, side);
  return lines ? CarrierResult<std::unique_ptr<LinePort>>(std::move(*lines))
               : tl::unexpected<CarrierError>(lines.error());
}

}  // namespace towbench::protocol
