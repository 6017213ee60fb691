#include "protocol/carriers/line_address.h"

#include <charconv>
#include <optional>

#include "protocol/carriers/sim_lines.h"

namespace towbench::protocol {
namespace {

constexpr std::string_view kSimulated = "sim:";

// Reads the number behind `mark` and cuts both off; true where there is none. A second of debounce
// is longer than any switch bounces.
bool read_tail(std::string_view& text, char mark, unsigned& into, unsigned most) {
  const auto at = text.find(mark);
  if (at == std::string_view::npos) {
    return true;
  }
  const auto digits = text.substr(at + 1);
  text = text.substr(0, at);
  const auto* end = digits.data() + digits.size();
  const auto number = std::from_chars(digits.data(), end, into);
  return number.ec == std::errc() && number.ptr == end && into <= most;
}

std::optional<GpioPlace> parsed(std::string_view text, bool is_simulated) {
  constexpr unsigned kMostLines = 1U << 20U;
  constexpr unsigned kLongestDebounce_ms = 1000;
  GpioPlace place;
  unsigned debounce_ms = 0;
  const bool is_good = read_tail(text, '~', debounce_ms, kLongestDebounce_ms) &&
                       read_tail(text, '+', place.first_line, kMostLines) && !text.empty() &&
                       !(is_simulated && debounce_ms > 0);
  place.chip = text;
  place.debounce_ns = debounce_ms * core::kNanosecondsPerMillisecond;
  return is_good ? std::optional(place) : std::nullopt;
}

template <typename Opened>
CarrierResult<std::unique_ptr<LinePort>> as_port(CarrierResult<std::unique_ptr<Opened>> opened) {
  return opened ? CarrierResult<std::unique_ptr<LinePort>>(std::move(*opened))
                : tl::unexpected<CarrierError>(opened.error());
}

}  // namespace

CarrierResult<std::unique_ptr<LinePort>> open_lines(std::string_view address, LineSide side) {
  const bool is_simulated = address.starts_with(kSimulated);
  const auto place = parsed(address.substr(is_simulated ? kSimulated.size() : 0), is_simulated);
  if (!place || (is_simulated && side == LineSide::kController)) {
    return carrier_failure(core::ErrorCode::kTransportFailed,
                           '"' + std::string(address) + "\" is no place of lines (allowed: " +
                               std::string(kLineForms) + ")");
  }
  return is_simulated ? as_port(SimLines::open(place->chip, place->first_line))
                      : as_port(GpioLines::open(*place, side));
}

}  // namespace towbench::protocol
