// The eQEP peripheral of the emulated board: A, B and index edges in, position counter, capture
// unit and flags out.
//
//   count    x4: with A leading B towards max, an edge of A counts up when A = B before it, an edge
//            of B when A != B; down otherwise
//   illegal  both channels change within one period of the peripheral's 100 MHz clock: the count
//            stays, the flag's counter goes up (QFLG.PHE)
//   capture  a free-running prescaled clock; each edge latches the ticks since the edge before
//            (QCPRD) and restarts the timer; 16 bits, saturating (QEPSTS.COEF); a reversal between
//            the two edges makes the latch invalid (QEPSTS.CDEF)
//   index    its rising edge latches the count (QPOSILAT)
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bbmc/device/eqep.h"
#include "core/realtime.h"
#include "core/time.h"
#include "protocol/messages.h"

namespace towbench::bbmc {

// When an encoder's last two edges came: what the capture unit's registers are made of.
struct EdgeTimes {
  core::Nanoseconds heard_until_ns = 0;
  core::Nanoseconds last_ns = 0;
  core::Nanoseconds before_ns = 0;  // 0 = none yet
  std::int32_t last_step = 0;       // +-1, 0 = none yet
  bool reversed = false;            // between the two
};

class QuadratureDecoder {
 public:
  // Edges of one message. False when it does not continue the one before (a message was lost).
  TOWBENCH_REALTIME [[nodiscard]] bool take(const protocol::EncoderEdges& message) noexcept;
  // The digest of a peripheral at the far end of a narrow link. Same meaning of the result.
  TOWBENCH_REALTIME [[nodiscard]] bool take(const protocol::EncoderReport& report) noexcept;

  // Registers as of the end of the last message.
  TOWBENCH_REALTIME [[nodiscard]] Eqep::Reading read() const noexcept;
  // As of the same moment, for whoever makes those registers elsewhere.
  TOWBENCH_REALTIME [[nodiscard]] EdgeTimes edge_times() const noexcept {
    return {.heard_until_ns = time_ns_,
            .last_ns = counter_.last_edge_ns,
            .before_ns = counter_.edge_before_ns,
            .last_step = counter_.last_step,
            .reversed = counter_.reversed};
  }

  // False, and nothing changed, when the clock's period is not a whole number of nanoseconds.
  [[nodiscard]] bool configure(const Eqep::Settings& settings) noexcept;
  void load_position(std::uint32_t position) noexcept;

  // A and B edges decoded from edge messages since the start.
  [[nodiscard]] std::uint64_t edges_seen() const noexcept { return counter_.edges; }

 private:
  [[nodiscard]] bool is_old(std::uint32_t sequence) const noexcept;
  [[nodiscard]] bool continues(std::uint32_t sequence, core::Nanoseconds start_ns) noexcept;
  void adopt_levels(std::uint8_t levels, core::Nanoseconds time_ns) noexcept;
  [[nodiscard]] std::uint32_t wrapped(std::int64_t count) const noexcept;

  // Everything an edge changes, in one piece so that the loop over edges can keep it in registers.
  struct Counter {
    std::int64_t count = 0;
    core::Nanoseconds last_edge_ns = 0;
    core::Nanoseconds edge_before_ns = 0;
    std::uint64_t edges = 0;
    std::int64_t index_count = 0;
    std::uint32_t parity = 0;     // A xor B
    std::uint32_t last_line = 2;  // 0 A, 1 B
    std::int32_t last_step = 0;   // +-1, 0 = none yet
    std::uint32_t illegal = 0;
    std::uint32_t index_pulses = 0;
    bool reversed = false;  // between the last two edges
    bool index_level = false;

    void channel(std::uint32_t line, core::Nanoseconds time_ns) noexcept;
    void index(bool rises) noexcept;
    // Steady motion: channels alternate, so the direction stays. Takes such edges from the front,
    // moves `time_ns` along, and returns how many they were.
    std::size_t steady(std::span<const protocol::EncoderEdge> edges,
                       core::Nanoseconds& time_ns) noexcept;
  };

  Eqep::Settings settings_;
  core::Nanoseconds capture_tick_ns_ = 640;  // 100 MHz / 64
  Counter counter_;
  core::Nanoseconds time_ns_ = 0;
  std::uint32_t next_sequence_ = 0;
  std::uint8_t levels_ = 0;
  bool started_ = false;
  bool edges_known_ = true;
};

}  // namespace towbench::bbmc
