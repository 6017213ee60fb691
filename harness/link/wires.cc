#include "harness/link/wires.h"

#include "protocol/carriers/encoder_address.h"
#include "protocol/carriers/line_address.h"

namespace towbench::harness {

using protocol::CarrierError;
using protocol::CarrierResult;

namespace {

CarrierResult<std::unique_ptr<protocol::LinePort>> open_digital(const std::string& address,
                                                                protocol::LineSide side,
                                                                EdgeTimes times) {
  if (protocol::is_debounced(address) && times == EdgeTimes::kOfExchange) {
    return protocol::carrier_failure(core::ErrorCode::kTransportFailed,
                                     address +
                                         ": a debounce lasts by the host's clock; in "
                                         "lockstep there is none");
  }
  return protocol::open_lines(address, side);
}

}  // namespace

CarrierResult<std::unique_ptr<WiredPlant>> WiredPlant::open(PlantEnd& plant,
                                                            const WireAddresses& addresses,
                                                            EdgeTimes times) {
  std::unique_ptr<WiredPlant> wired(new WiredPlant(plant));
  if (!addresses.lines.empty()) {
    auto lines = open_digital(addresses.lines, protocol::LineSide::kController, times);
    if (!lines) {
      return tl::unexpected<CarrierError>(lines.error());
    }
    wired->lines_ = std::move(*lines);
    wired->whole_ = &wired->lined_.emplace(*wired->whole_, *wired->lines_);
  }
  if (!addresses.encoders.empty()) {
    auto reader =
        protocol::parse_encoder_address(addresses.encoders).and_then(protocol::open_edge_reader);
    if (!reader) {
      return tl::unexpected<CarrierError>(reader.error());
    }
    wired->reader_ = std::move(*reader);
    wired->whole_ = &wired->counted_.emplace(*wired->whole_, *wired->reader_, times);
  }
  return wired;
}

CarrierResult<OpenedWires> open_plant_wires(const WireAddresses& addresses, EdgeTimes times) {
  OpenedWires opened;
  if (!addresses.lines.empty()) {
    auto lines = open_digital(addresses.lines, protocol::LineSide::kPlant, times);
    if (!lines) {
      return tl::unexpected<CarrierError>(lines.error());
    }
    opened.lines = std::move(*lines);
  }
  if (!addresses.encoders.empty()) {
    auto driver =
        protocol::parse_encoder_address(addresses.encoders).and_then(protocol::open_edge_driver);
    if (!driver) {
      return tl::unexpected<CarrierError>(driver.error());
    }
    opened.encoders = std::move(*driver);
  }
  return opened;
}

WiredPath::WiredPath(const emulator::PlantNode& node, protocol::MessageSink& to_plant,
                     protocol::MessageSink& to_controller, const PlantWires& wires, EdgeTimes times)
    : from_controller_(&to_plant), from_plant_(&to_controller) {
  if (wires.lines != nullptr) {
    lines_.emplace(*from_controller_, *from_plant_, *wires.lines);
    from_controller_ = &lines_->from_controller();
    from_plant_ = &lines_->to_controller();
  }
  if (wires.encoders != nullptr) {
    core::PerPlanarAxis<protocol::EncoderLevels> levels;
    for (const core::Axis axis : core::kPlanarAxes) {
      levels[axis] = node.encoder_levels(axis);
    }
    encoders_.emplace(*from_controller_, *from_plant_, *wires.encoders, levels,
                      times == EdgeTimes::kOfExchange);
    from_controller_ = &encoders_->from_controller();
    from_plant_ = &encoders_->to_controller();
  }
}

core::Status WiredPath::status() const noexcept {
  const auto lines = lines_ ? lines_->status() : core::Status();
  return !lines || !encoders_ ? lines : encoders_->status();
}

}  // namespace towbench::harness
