// What crosses between controller and plant. One set of messages, one meaning, on every carrier.
//
// Times are integer nanoseconds from the start of the run. The wire form of each message stands in
// docs/reference/protocol.md and is produced by codec.h; in process no wire form exists and
// messages are handed over by reference (message_sink.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/axis.h"
#include "core/bounded_vector.h"
#include "core/error.h"
#include "core/time.h"

namespace towbench::protocol {

inline constexpr std::uint16_t kProtocolVersion = 2;

enum class Role : std::uint8_t { kController = 0, kPlant = 1, kObserver = 2 };

// Bits of Hello::capabilities.
inline constexpr std::uint32_t kCapabilityEdges = 1U << 0U;      // EncoderEdges
inline constexpr std::uint32_t kCapabilityDigest = 1U << 1U;     // EncoderReport
inline constexpr std::uint32_t kCapabilityReference = 1U << 2U;  // Reference: wanted, or given
inline constexpr std::uint32_t kCapabilityReset = 1U << 3U;      // Reset: taken, or given
inline constexpr std::uint32_t kCapabilityAbsolute = 1U << 4U;   // AbsoluteCount: wanted, or given

// First message of each side. A mismatch is refused with both sides named (handshake.h).
struct Hello {
  std::uint16_t version = kProtocolVersion;
  Role role = Role::kController;
  std::uint8_t axes_mask = 0;     // bit index_of(axis)
  std::uint32_t tick_ns = 0;      // the plant's step
  std::uint32_t exchange_ns = 0;  // time between two Advance messages in lockstep
  std::uint32_t capabilities = 0;
  std::uint64_t fixture_hash = 0;  // of the rig, as both sides read it; 0 = not known, accept any
};

// The plant's answer to Hello, with what it is and whether it agrees.
struct HelloReply {
  Hello plant;
  core::ErrorCode refusal = core::ErrorCode::kNone;
};

// The two half-bridge channels of one axis. At most one is non-zero: A drives towards max, B
// towards min. Ticks are of the PWM counter; duty = ticks / period.
struct PwmDuty {
  core::Axis axis = core::kFirstAxis;
  bool enable = false;
  std::uint16_t channel_a_ticks = 0;
  std::uint16_t channel_b_ticks = 0;
  std::uint16_t period_ticks = 0;  // > 0
  std::uint32_t sequence = 0;      // + 1 for each message of this axis
};

enum class EncoderLine : std::uint8_t { kA = 0, kB = 1, kIndex = 2 };

// One toggle of one line, packed as on the wire: time since the previous edge of the message (or
// its start) in the low 30 bits, line in the upper two.
class EncoderEdge {
 public:
  static constexpr std::uint32_t kMaxStep_ns = (1U << 30U) - 1U;

  constexpr EncoderEdge() noexcept = default;
  constexpr EncoderEdge(std::uint32_t step_ns, EncoderLine line) noexcept
      : packed_((static_cast<std::uint32_t>(line) << 30U) | (step_ns & kMaxStep_ns)) {}
  static constexpr EncoderEdge from_packed(std::uint32_t packed) noexcept {
    EncoderEdge edge;
    edge.packed_ = packed;
    return edge;
  }
  [[nodiscard]] constexpr std::uint32_t packed() const noexcept { return packed_; }
  [[nodiscard]] constexpr std::uint32_t step_ns() const noexcept { return packed_ & kMaxStep_ns; }
  // 3 is not a line; the codec refuses it.
  [[nodiscard]] constexpr EncoderLine line() const noexcept {
    return static_cast<EncoderLine>(packed_ >> 30U);
  }
  friend constexpr bool operator==(EncoderEdge, EncoderEdge) = default;

 private:
  std::uint32_t packed_ = 0;
};

// Levels of the three lines of one encoder as a bit field: bit 0 A, bit 1 B, bit 2 index.
using EncoderLevels = std::uint8_t;

inline constexpr std::size_t kMaxEdgesPerMessage = 1024;

// Every edge of one axis in [start, end), oldest first. More than kMaxEdgesPerMessage in one
// exchange go into several messages, each starting where the one before ended.
struct EncoderEdges {
  core::Axis axis = core::kFirstAxis;
  EncoderLevels start_levels = 0;
  core::Nanoseconds start_ns = 0;
  core::Nanoseconds end_ns = 0;
  std::uint32_t sequence = 0;
  core::BoundedVector<EncoderEdge, kMaxEdgesPerMessage> edges;
};

// The digest of the same for narrow links: what a quadrature peripheral at the plant's side saw.
struct EncoderReport {
  core::Axis axis = core::kFirstAxis;
  EncoderLevels levels = 0;
  core::Nanoseconds time_ns = 0;  // end of the interval reported
  std::int32_t count_change = 0;
  core::Nanoseconds last_edge_ns = 0;     // 0 = none since the start of the run
  std::uint32_t capture_period_ns = 0;    // between the last two edges; 0 = unknown
  std::int32_t index_count = 0;           // count at the last index pulse
  std::uint16_t index_pulses = 0;         // in the interval
  std::uint16_t illegal_transitions = 0;  // in the interval
  std::uint32_t sequence = 0;
};

// Lines from the machine to the controller, one bit each; 1 = active.
enum class InputLine : std::uint8_t {
  kHallYMin = 0,
  kHallYMax = 1,
  kHallXMin = 2,
  kHallXMax = 3,
  kKillSwitch = 4,
  kAmplifierReadyY = 5,
  kAmplifierReadyX = 6,
  kHallZMin = 7,
  kHallZMax = 8,
  kHallAMin = 9,
  kHallAMax = 10,
  kHallBMin = 11,
  kHallBMax = 12,
  kHallCMin = 13,
  kHallCMax = 14,
  kFurtherAmplifiersReady = 15,  // of z to c, their contacts in series
  kHomeY = 16,
  kHomeX = 17,
  kHomeZ = 18,
  kHomeA = 19,
  kHomeB = 20,
  kHomeC = 21,
};
inline constexpr std::size_t kInputLineCount = 22;

// Bit of each InputLine; 1 = active.
using InputLines = std::uint32_t;

[[nodiscard]] constexpr InputLines mask_of(InputLine line) noexcept {
  return InputLines{1} << static_cast<unsigned>(line);
}

// All lines as they are from `change_ns` on. Sent once at start and at each change, with the
// change's own time inside the plant step.
struct DigitalInputs {
  InputLines lines = 0;
  core::Nanoseconds change_ns = 0;
  std::uint32_t sequence = 0;
};

[[nodiscard]] constexpr InputLine hall_line(core::Axis axis, bool at_max) noexcept {
  const std::size_t nth = core::index_of(axis);
  const std::size_t first =
      nth < 2 ? 2 * nth : static_cast<std::size_t>(InputLine::kHallZMin) + 2 * (nth - 2);
  return static_cast<InputLine>(first + (at_max ? 1 : 0));
}

[[nodiscard]] constexpr InputLine ready_line(core::Axis axis) noexcept {
  return core::is_planar(axis)
             ? static_cast<InputLine>(static_cast<std::size_t>(InputLine::kAmplifierReadyY) +
                                      core::index_of(axis))
             : InputLine::kFurtherAmplifiersReady;
}

[[nodiscard]] constexpr InputLine home_line(core::Axis axis) noexcept {
  return static_cast<InputLine>(static_cast<std::size_t>(InputLine::kHomeY) + core::index_of(axis));
}

enum class OutputLine : std::uint8_t {
  kAmplifierEnableY = 0,
  kAmplifierEnableX = 1,
  kAmplifierEnableZ = 2,
  kAmplifierEnableA = 3,
  kAmplifierEnableB = 4,
  kAmplifierEnableC = 5,
  kBrakeReleaseY = 6,  // 1: the holding brake's coil is energised
  kBrakeReleaseX = 7,
  kBrakeReleaseZ = 8,
  kBrakeReleaseA = 9,
  kBrakeReleaseB = 10,
  kBrakeReleaseC = 11,
};
inline constexpr std::size_t kOutputLineCount = 12;

// A cable for lines, not for messages, carries those of a machine of two axes.
inline constexpr std::size_t kWiredInputLines = 7;
inline constexpr std::size_t kWiredOutputLines = 2;

[[nodiscard]] constexpr OutputLine enable_line(core::Axis axis) noexcept {
  return static_cast<OutputLine>(core::index_of(axis));
}

[[nodiscard]] constexpr OutputLine brake_line(core::Axis axis) noexcept {
  return static_cast<OutputLine>(static_cast<std::size_t>(OutputLine::kBrakeReleaseY) +
                                 core::index_of(axis));
}

[[nodiscard]] constexpr std::uint16_t mask_of(OutputLine line) noexcept {
  return static_cast<std::uint16_t>(1U << static_cast<unsigned>(line));
}

struct DigitalOutputs {
  std::uint16_t lines = 0;
  core::Nanoseconds change_ns = 0;
  std::uint32_t sequence = 0;
};

// Force/torque between mount and shaft, sensor frame = tank frame at zero yaw.
struct ForceSample {
  core::Nanoseconds time_ns = 0;
  std::array<float, 3> force_N{};
  std::array<float, 3> torque_Nm{};
};

struct CurrentSample {
  core::Axis axis = core::kFirstAxis;
  core::Nanoseconds time_ns = 0;
  float armature_current_A = 0;
};

// Where an axis is to be, for a controller that has no reference of its own and asks for one
// (kCapabilityReference). Counted from where the axis stood when the run began.
struct Reference {
  core::Axis axis = core::kFirstAxis;
  core::Nanoseconds time_ns = 0;
  float position_m = 0;
  float velocity_m_per_s = 0;
  float acceleration_m_per_s2 = 0;
};

// The whole count of an absolute encoder, for a controller that asks for it (kCapabilityAbsolute):
// the floor of the true place in counts, 0 at the zero of the rig. Of a count beyond 32 bits the
// low ones.
struct AbsoluteCount {
  core::Axis axis = core::kFirstAxis;
  core::Nanoseconds time_ns = 0;  // when it was that count
  std::int32_t count = 0;
  std::uint32_t sequence = 0;  // + 1 for each message of this axis
};

// The operator asks a controller to leave its safe state, one that takes it (kCapabilityReset).
struct Reset {
  core::Nanoseconds time_ns = 0;
};

// Lockstep, controller to plant: "all my outputs up to now are sent; run until this time."
struct Advance {
  core::Nanoseconds until_ns = 0;
};

// Lockstep, plant to controller: "all that happened until this time is sent."
struct Advanced {
  core::Nanoseconds time_ns = 0;
};

struct Heartbeat {
  core::Nanoseconds time_ns = 0;
  std::uint32_t sequence = 0;
};

// Something the sender found wrong, for the other side's record.
struct Fault {
  core::ErrorCode code = core::ErrorCode::kNone;
  core::Nanoseconds time_ns = 0;
  std::uint32_t detail = 0;  // meaning belongs to the code: an axis, a line, a count
};

// Orderly end. The receiver removes the drive, answers with its own Bye, and stops.
struct Bye {
  core::Nanoseconds time_ns = 0;
};

}  // namespace towbench::protocol
