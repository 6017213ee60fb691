// What a carrier must carry in the worst case, reckoned before a run; above 80 % it is refused.
//
// Reckoned for real time, where a byte that comes late is a fault. In lockstep time waits for the
// carrier, and Advance / Advanced are added.
#pragma once

#include <cstdint>

#include "core/time.h"
#include "protocol/carriers/carrier_error.h"

namespace towbench::protocol {

inline constexpr double kMaxLoad = 0.8;

enum class Fidelity : std::uint8_t { kEdges, kDigest };

struct Traffic {
  unsigned axes = 2;
  Fidelity fidelity = Fidelity::kDigest;
  bool lockstep = false;
  core::Nanoseconds exchange_ns = core::kNanosecondsPerMillisecond;
  // Of one axis: the faster one at its voltage limit, 0.382 m/s x 742,241 counts/m
  // (docs/reference/constants.md: the platform).
  double edges_per_s = 283'536.0;
  // Index pulses of one axis: one a motor turn of 4000 counts.
  double index_pulses_per_s = 70.9;
  // Changes of the input lines, and as many of the output lines: a switch that bounces.
  double line_changes_per_s = 200.0;
  bool force_samples = false;    // one an exchange
  bool current_samples = false;  // one an axis and exchange
  bool references = false;       // the same
  bool absolute_counts = false;  // the same
};

struct Load {
  double to_plant_bit_per_s = 0.0;
  double to_controller_bit_per_s = 0.0;
  double capacity_bit_per_s = 0.0;  // of each direction, or of both together on a bus
  bool is_shared = false;           // a bus

  // Of the direction that is worse off, or of the bus. 1 = full.
  [[nodiscard]] double fraction() const noexcept;
};

// COBS frames on a serial line of ten bits a byte, full duplex.
[[nodiscard]] Load serial_load(const Traffic& traffic, std::uint32_t baud) noexcept;

// CAN frames with the worst bit stuffing, both directions on one bus. Edges need FD frames
// (can_packer.h), whose data go at a rate of their own and count for the time that they take, in
// bits of the nominal rate. A data rate of 0: a bus without FD, and the load of edges is infinite.
[[nodiscard]] Load can_load(const Traffic& traffic, std::uint32_t bit_per_s,
                            std::uint32_t data_bit_per_s = 0) noexcept;

// Refuses a load above kMaxLoad with kCarrierOverloaded and both figures.
[[nodiscard]] CarrierResult<void> accept_load(const Load& load, const std::string& carrier_name);

}  // namespace towbench::protocol
