// The real lines of a run around whatever else carries it: digital lines, encoder lines, both or
// none.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "emulator/plant_node.h"
#include "harness/link/encoder_lines.h"
#include "harness/link/plant_end.h"
#include "harness/link/real_lines.h"
#include "protocol/carriers/carrier_error.h"
#include "protocol/carriers/edge_port.h"
#include "protocol/carriers/line_port.h"

namespace towbench::harness {

// As a user writes one side's; empty: over the carrier.
struct WireAddresses {
  std::string lines;     // line_address.h
  std::string encoders;  // encoder_address.h
};

// The controller's side: the plant with its lines beside it.
class WiredPlant {
 public:
  // `plant` outlives this. Refused with a sentence for the user; a debounce in lockstep too,
  // because it lasts by the host's clock.
  [[nodiscard]] static protocol::CarrierResult<std::unique_ptr<WiredPlant>> open(
      PlantEnd& plant, const WireAddresses& addresses, EdgeTimes times);

  [[nodiscard]] PlantEnd& whole() noexcept { return *whole_; }

 private:
  explicit WiredPlant(PlantEnd& plant) noexcept : whole_(&plant) {}

  std::unique_ptr<protocol::LinePort> lines_;
  std::unique_ptr<protocol::EdgeReader> reader_;
  std::optional<RealLinesAtController> lined_;
  std::optional<EncoderLinesAtController> counted_;
  PlantEnd* whole_;
};

// The plant's side.
struct PlantWires {
  protocol::LinePort* lines = nullptr;       // null: they are messages
  protocol::EdgeDriver* encoders = nullptr;  // the same
};

// What was opened of one plant's lines; PlantWires point into it.
struct OpenedWires {
  std::unique_ptr<protocol::LinePort> lines;
  std::unique_ptr<protocol::EdgeDriver> encoders;

  [[nodiscard]] PlantWires wires() const noexcept { return {lines.get(), encoders.get()}; }
};
[[nodiscard]] protocol::CarrierResult<OpenedWires> open_plant_wires(const WireAddresses& addresses,
                                                                    EdgeTimes times);

// Stands on both ways of the plant.
class WiredPath {
 public:
  // All outlive this. Messages to the plant go through it to `to_plant`, those of the plant to
  // `to_controller`; `node` is asked for its encoders' levels only.
  WiredPath(const emulator::PlantNode& node, protocol::MessageSink& to_plant,
            protocol::MessageSink& to_controller, const PlantWires& wires, EdgeTimes times);

  [[nodiscard]] protocol::MessageSink& from_controller() noexcept { return *from_controller_; }
  [[nodiscard]] protocol::MessageSink& from_plant() noexcept { return *from_plant_; }
  // The first failure of a line.
  [[nodiscard]] core::Status status() const noexcept;

 private:
  std::optional<RealLinesAtPlant> lines_;
  std::optional<EncoderLinesAtPlant> encoders_;
  protocol::MessageSink* from_controller_;
  protocol::MessageSink* from_plant_;
};

}  // namespace towbench::harness
