#include "protocol/carriers/encoder_address.h"

#include <charconv>

#include "protocol/carriers/sim_edges.h"

namespace towbench::protocol {
namespace {

// The end of `text` from the last `mark` on, cut off and without it; "" where there is none.
std::string_view cut_off(std::string_view& text, std::string_view mark) {
  const auto at = text.rfind(mark);
  if (at == std::string_view::npos) {
    return {};
  }
  const auto tail = text.substr(at + mark.size());
  text = text.substr(0, at);
  return tail;
}

// True when all of `text` is one number.
bool read_number(std::string_view text, unsigned& into) {
  const auto* end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, into);
  return number.ec == std::errc() && number.ptr == end;
}

template <typename Port, typename Opened>
CarrierResult<std::unique_ptr<Port>> as_port(CarrierResult<std::unique_ptr<Opened>> opened) {
  return opened ? CarrierResult<std::unique_ptr<Port>>(std::move(*opened))
                : tl::unexpected<CarrierError>(opened.error());
}

}  // namespace

CarrierResult<EncoderAddress> parse_encoder_address(std::string_view text) {
  constexpr std::string_view kSimulated = "sim:";
  constexpr std::string_view kIndex = ":index";
  EncoderAddress address;
  address.is_simulated = text.starts_with(kSimulated);
  auto rest = text.substr(address.is_simulated ? kSimulated.size() : 0);
  bool is_good = true;
  if (rest.find('@') != std::string_view::npos) {
    unsigned rate = 0;
    is_good = read_number(cut_off(rest, "@"), rate) && rate > 0;
    address.rated_edges_per_s = rate;
  }
  if (rest.ends_with(kIndex)) {
    address.place.with_index = true;
    rest.remove_suffix(kIndex.size());
  }
  if (rest.find('+') != std::string_view::npos) {
    is_good = read_number(cut_off(rest, "+"), address.place.first_line) && is_good;
  }
  address.place.chip = rest;
  if (!is_good || rest.empty() || rest.find(':') != std::string_view::npos) {
    return carrier_failure(core::ErrorCode::kTransportFailed,
                           '"' + std::string(text) + "\" is no place of encoder lines (allowed: " +
                               std::string(kEncoderLineForms) + ")");
  }
  return address;
}

CarrierResult<std::unique_ptr<EdgeReader>> open_edge_reader(const EncoderAddress& address) {
  if (address.is_simulated) {
    return carrier_failure(core::ErrorCode::kTransportFailed,
                           "sim:" + address.place.chip + ": is the machine's side");
  }
  return as_port<EdgeReader>(GpioEdgeReader::open(address.place));
}

CarrierResult<std::unique_ptr<EdgeDriver>> open_edge_driver(const EncoderAddress& address) {
  return address.is_simulated ? as_port<EdgeDriver>(SimEdgeDriver::open(address.place))
                              : as_port<EdgeDriver>(GpioEdgeDriver::open(address.place));
}

}  // namespace towbench::protocol
