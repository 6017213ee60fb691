// One conversation with a controller: handshake, then exchanges in lockstep, then the end. What
// PlantNode does, without its face.
//
// An exchange, at Advance{T + dt} (docs/decisions/0001-walls.md): step the rig from T to T + dt,
// sending CurrentSample and ForceSample as they are taken, then EncoderEdges (or EncoderReport) of
// each axis in the order of core/axis.h, each with its AbsoluteCount behind it where it has one and
// the controller wants it, then DigitalInputs of each change in the order of time, then the
// operator's Reset, then Advanced. Whatever a controller sends that makes no sense is counted,
// answered by a Fault, and changes nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/bounded_vector.h"
#include "emulator/edge_stream.h"
#include "emulator/event_script.h"
#include "emulator/fault_reporter.h"
#include "emulator/machine_watch.h"
#include "emulator/plant_node.h"
#include "emulator/rig.h"
#include "emulator/sensors/encoder_digest.h"

namespace towbench::emulator {

class PlantExchange {
 public:
  // Longest interval of one Advance. Also keeps every edge's step within its 30 bits.
  static constexpr core::Nanoseconds kMaxAdvance_ns = core::kNanosecondsPerSecond;

  PlantExchange(const RigParameters& rig, std::uint64_t seed,
                std::span<const ScheduledEvent> events, PlantObserver& observer);

  void connect(protocol::MessageSink& controller) noexcept {
    sink_ = &controller;
    faults_.connect(controller);
  }

  void greet(const protocol::Hello& hello) noexcept;
  TOWBENCH_REALTIME void drive(const protocol::PwmDuty& duty) noexcept;
  TOWBENCH_REALTIME void set_outputs(const protocol::DigitalOutputs& outputs) noexcept;
  TOWBENCH_REALTIME void advance(const protocol::Advance& advance) noexcept;
  void add_event(const ScheduledEvent& event) { script_.add(event); }
  void note_fault(const protocol::Fault& fault) noexcept;
  void end(const protocol::Bye& bye) noexcept;
  void peer_lost(core::ErrorCode why) noexcept;

  [[nodiscard]] const std::string& failure() const noexcept { return rig_.failure(); }
  [[nodiscard]] bool finished() const noexcept { return finished_; }
  [[nodiscard]] core::Nanoseconds now_ns() const noexcept { return rig_.now_ns(); }
  [[nodiscard]] protocol::EncoderLevels encoder_levels(core::Axis which) const noexcept {
    const RigAxis* axis = rig_.axis(which);
    return axis != nullptr ? axis->encoder().levels() : protocol::EncoderLevels{0};
  }

 private:
  struct AxisOutputs {
    EdgeStream edges;
    EncoderDigest digest;
    std::uint32_t absolute_sequence = 0;
  };

  [[nodiscard]] protocol::Hello own_hello(const protocol::Hello& theirs) const noexcept;
  [[nodiscard]] core::ErrorCode objection(const protocol::Advance& advance) const noexcept;
  void forget_controller() noexcept;
  void remove_drive(core::ErrorCode why) noexcept;
  void end_failed() noexcept;

  void tick() noexcept;
  void collect_lines() noexcept;
  void send_samples() noexcept;
  void send_outputs() noexcept;
  void send_absolute(core::Axis which) noexcept;
  void send_lines() noexcept;
  void pass_reset(core::Nanoseconds time_ns) noexcept;
  void report(core::ErrorCode code, core::Axis axis, std::uint32_t detail) noexcept {
    faults_.report(now_ns(), code, axis, detail);
  }

  Rig rig_;
  std::uint64_t fixture_hash_;
  std::uint32_t capabilities_;
  EventScript script_;
  PlantObserver* observer_;
  FaultReporter faults_;
  MachineWatch watch_;
  protocol::MessageSink* sink_ = nullptr;
  core::PerAxis<std::optional<AxisOutputs>> outputs_;

  std::optional<core::Nanoseconds> reset_ns_;  // the operator's, in this exchange

  // DigitalInputs of this exchange, sent behind the edges.
  core::BoundedVector<protocol::DigitalInputs, 64> pending_lines_;
  protocol::InputLines sent_lines_ = 0;
  std::uint32_t line_sequence_ = 0;
  std::uint32_t output_sequence_ = 0;
  bool output_sequence_known_ = false;

  bool greeted_ = false;
  bool sends_edges_ = false;
  bool sends_digest_ = false;
  bool takes_reset_ = false;
  bool takes_absolute_ = false;
  bool finished_ = false;
};

}  // namespace towbench::emulator
