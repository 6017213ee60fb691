// eQEP (AM335x TRM 15.4): quadrature decoder x4, index latch, unit timer, watchdog and edge-capture
// unit, clocked at 100 MHz.
//
//   count     A leading B counts up; wraps 0 .. QPOSMAX; both channels within one clock is a phase
//             error: the count stays, QFLG.PHE
//   capture   QCTMR runs at 100 MHz / 2^CCPS; every 2^UPPS-th count latches it into QCPRD, clears
//             it and sets UPEVNT; its overflow sets COEF, a reversal between two latches CDEF
//   latches   QCTMRLAT and QCPRDLAT follow a read of QPOSCNT, or the unit timer with QCLM
//
// Quadrature-count mode only (QDECCTL.QSRC = 0); the other three sources are noted and do not
// count.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>

#include "board/halfword_block.h"

namespace towbench::board {

enum class EncoderLine : std::uint8_t { kA = 0, kB = 1, kIndex = 2 };

class Eqep final : public HalfwordBlock {
 public:
  using Interrupt = std::function<void(bool raised)>;

  Eqep(std::string name, Bus& bus, Interrupt interrupt);

  // Bit 0 A, bit 1 B, bit 2 index, from now on.
  void set_levels(std::uint8_t levels) noexcept { levels_ = levels; }
  [[nodiscard]] std::uint8_t levels() const noexcept { return levels_; }
  // A line toggles at `time_ns`; times do not decrease.
  void push_edge(EncoderLine line, core::Nanoseconds time_ns) { edges_.push_back({time_ns, line}); }

  // A and B edges that were decoded since power came on.
  [[nodiscard]] std::uint64_t edges_decoded() const noexcept { return edges_decoded_; }
  // QPOSCNT as the image has loaded it, and every step since, however it wraps.
  [[nodiscard]] std::int64_t count() const noexcept { return loaded_ + steps_; }

  void advance(core::Nanoseconds now_ns) override;
  [[nodiscard]] core::Nanoseconds next_event_ns() const override;
  void reset() override;

 protected:
  std::uint32_t read_word(std::uint32_t offset, std::uint32_t lanes) override;
  void write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) override;
  std::uint16_t read_half(std::uint32_t offset) override;
  void write_half(std::uint32_t offset, std::uint16_t value, std::uint16_t lanes) override;

 private:
  struct Edge {
    core::Nanoseconds time_ns = 0;
    EncoderLine line = EncoderLine::kA;
  };

  void take(const Edge& edge);
  void take_channel(unsigned line, core::Nanoseconds time_ns);
  void take_index(bool rises);
  void step(int direction, core::Nanoseconds time_ns);
  void unit_time_out(core::Nanoseconds time_ns);
  void control_written(std::uint16_t before);
  void load_position(std::uint32_t value) noexcept;
  void capture(core::Nanoseconds time_ns);
  void watch_overflow(core::Nanoseconds time_ns);
  void restart_capture(core::Nanoseconds time_ns) noexcept;
  [[nodiscard]] std::int64_t capture_ticks(core::Nanoseconds time_ns) const noexcept;
  [[nodiscard]] bool counts() const noexcept;
  [[nodiscard]] core::Nanoseconds unit_due_ns() const noexcept;
  void flag(std::uint16_t bits);
  void update_line();

  Interrupt interrupt_;
  std::deque<Edge> edges_;
  std::uint8_t levels_ = 0;
  std::uint64_t edges_decoded_ = 0;
  std::int64_t steps_ = 0;   // since power came on, whatever is loaded
  std::int64_t loaded_ = 0;  // what has to be added to them
  core::Nanoseconds last_edge_ns_ = -kNever;
  unsigned last_line_ = 2;
  int last_step_ = 0;
  bool first_index_seen_ = false;
  std::uint32_t position_ = 0;
  std::uint16_t flags_ = 0;
  std::uint16_t status_ = 0;
  std::uint32_t counts_to_unit_ = 0;
  std::int64_t capture_base_ = 0;  // tick at which QCTMR was 0
  std::int64_t overflows_told_ = 0;
  std::uint16_t period_ = 0;
  bool reversed_ = false;  // since the last latch
  core::Nanoseconds unit_base_ns_ = 0;
  core::Nanoseconds watchdog_base_ns_ = 0;
  bool watchdog_told_ = false;
};

}  // namespace towbench::board
