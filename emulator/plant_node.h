// The plant's end of the protocol: receives duty, runs the rig at 10 kHz, sends edges and lines.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "core/axis.h"
#include "core/time.h"
#include "emulator/faults/scheduled_event.h"
#include "emulator/rig_parameters.h"
#include "emulator/sensors/camera.h"
#include "emulator/truth_row.h"
#include "protocol/message_sink.h"

namespace towbench::emulator {

// Receives what only the emulator knows, and what its sensors say at their own rates. Called from
// the thread that runs the plant, inside on(Advance): an observer copies and returns.
class PlantObserver {
 public:
  PlantObserver() = default;
  PlantObserver(const PlantObserver&) = delete;
  PlantObserver& operator=(const PlantObserver&) = delete;
  virtual ~PlantObserver() = default;
  virtual void on_truth(const TruthRow& row) noexcept = 0;
  virtual void on_event(const PlantEvent& event) noexcept = 0;
  // Each sample of a sensor that is fitted, when it is taken: what the sensor says, no truth.
  // Nothing that a controller is sent.
  virtual void on_frame(const CameraFrame& /*frame*/) noexcept {}
  virtual void on_force(const protocol::ForceSample& /*sample*/) noexcept {}
  virtual void on_current(const protocol::CurrentSample& /*sample*/) noexcept {}
  // A controller was refused at its greeting.
  virtual void on_refusal(const protocol::Hello& /*ours*/, const protocol::Hello& /*theirs*/,
                          core::ErrorCode /*why*/) noexcept {}
};

class PlantNode : public protocol::MessageSink {
 public:
  // `seed` feeds every random quantity of the rig; `events` are sorted by time.
  PlantNode(const RigParameters& rig, std::uint64_t seed, std::span<const ScheduledEvent> events,
            PlantObserver& observer);
  ~PlantNode() override;

  // Must precede the first message. The sink outlives this node.
  void connect(protocol::MessageSink& controller) noexcept;

  using MessageSink::on;
  void on(const protocol::Hello& hello) noexcept override;
  void on(const protocol::PwmDuty& duty) noexcept override;
  void on(const protocol::DigitalOutputs& outputs) noexcept override;
  void on(const protocol::Advance& advance) noexcept override;
  void on(const protocol::Fault& fault) noexcept override;
  void on(const protocol::Bye& bye) noexcept override;

  // An event that nobody had planned, at or after now_ns(). Between two messages.
  void add_event(const ScheduledEvent& event);

  // The carrier calls this when the controller is gone: drive removed, event recorded.
  void peer_lost(core::ErrorCode why) noexcept;

  [[nodiscard]] bool finished() const noexcept;
  // Of the rig's foreign plant, in one line: it has ended the conversation. Empty: none.
  [[nodiscard]] const std::string& failure() const noexcept;
  [[nodiscard]] core::Nanoseconds now_ns() const noexcept;
  // Of an encoder's lines before the first step: what real lines are set to before anybody counts
  // their edges. 0 for an axis that the rig has not.
  [[nodiscard]] protocol::EncoderLevels encoder_levels(core::Axis axis) const noexcept;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace towbench::emulator
