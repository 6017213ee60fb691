// An image on the virtual board wired to a plant, a tick of 100 us at a time.
//
// At T the plant has run to T under the duty that the pins showed at T - 100 us, and its edges and
// line changes carry their own times. The board then executes the same 100 us against them, and
// what its pins show at T drives the plant's next tick.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

#include "board/board.h"
#include "harness/board_bench/board_truth.h"
#include "harness/board_bench/debug_probe.h"
#include "harness/board_bench/firmware_node.h"
#include "harness/experiment/board_wiring.h"
#include "harness/fault_cases/case_record.h"
#include "harness/link/plant_end.h"
#include "harness/lockstep/duty_watch.h"
#include "harness/record/firmware_recorder.h"
#include "protocol/tee_sink.h"

namespace towbench::harness {

struct FirmwareMachine {
  PlantEnd& plant;
  BoardTruth& truth;           // that observes it
  CaseRecord* rows = nullptr;  // takes the rows and events that an image tells; may be null
};

class FirmwareBench {
 public:
  // All outlive this; the board has its image.
  FirmwareBench(board::Board& board, const BoardWiring& wiring, std::uint8_t axes_mask,
                std::uint64_t rig_hash, const FirmwareMachine& machine, FirmwareRecorder& recorder);

  // Handshake. Before anything else.
  [[nodiscard]] core::Status start() noexcept;
  // Executes up to now() and returns what the console printed.
  std::string_view serve();
  // Runs the plant a tick further; an error means that it is gone.
  [[nodiscard]] core::Status advance() noexcept;
  void finish();

  void type(std::string_view bytes);
  // The board was switched off and on: the image counts its time from here.
  void restarted() noexcept { row_seen_ = false; }
  // False until an image that is known has started; the script of a third-party image waits for its
  // prompt.
  [[nodiscard]] bool listens() const noexcept {
    return !probe_.has_port() || (row_seen_ && now_ns_ >= kStartUp_ns);
  }
  // No motion runs and nothing typed is unserved, as far as that can be known.
  [[nodiscard]] bool idle() const noexcept;
  [[nodiscard]] core::Nanoseconds now_ns() const noexcept { return now_ns_; }
  // How long the pins have driven no axis.
  [[nodiscard]] core::Nanoseconds undriven_ns() const noexcept { return duty_watch_.undriven_ns(); }
  [[nodiscard]] std::uint64_t rows_lost() const noexcept { return probe_.rows_lost(); }
  // Why the image cannot go on, in a sentence; empty while it can.
  [[nodiscard]] std::string failure() const;

  [[nodiscard]] unsigned watchdog_resets() const noexcept { return board_.watchdog_resets(); }
  [[nodiscard]] DebugProbe& probe() noexcept { return probe_; }
  // Rows of the log of a third-party image are this far apart.
  static constexpr core::Nanoseconds kStartUp_ns = 10 * core::kNanosecondsPerMillisecond;
  static constexpr core::Nanoseconds kPinRow_ns = core::kNanosecondsPerMillisecond;

 private:
  struct Decoded {
    core::Nanoseconds time_ns = 0;
    core::PerPlanarAxis<std::uint64_t> edges;
  };

  void take_records();
  void take_rows();
  void write_pin_row();
  [[nodiscard]] const Decoded& decoded_at(core::Nanoseconds time_ns) const;

  board::Board& board_;
  const BoardWiring& wiring_;
  PlantEnd& plant_;
  BoardTruth& truth_;
  CaseRecord* rows_;
  FirmwareRecorder& recorder_;
  FirmwareNode node_;
  DutyWatch duty_watch_;
  protocol::TeeSink to_plant_;
  DebugProbe probe_;
  std::deque<Decoded> decoded_;  // of the last exchanges
  core::PerPlanarAxis<std::uint64_t> edges_told_;
  core::Nanoseconds now_ns_ = 0;
  core::Nanoseconds next_pin_row_ns_ = 0;
  core::Nanoseconds row_offset_ns_ = 0;
  bool row_seen_ = false;
  core::Nanoseconds driven_last_ns_ = 0;
  core::Nanoseconds typed_last_ns_ = 0;
  std::string console_;
};

}  // namespace towbench::harness
