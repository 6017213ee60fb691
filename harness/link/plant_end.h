// What stands at the other end of the controller's wire: the plant in this process, or a link to
// the process that runs it.
#pragma once

#include "core/result.h"
#include "emulator/faults/scheduled_event.h"
#include "harness/link/link_faults.h"
#include "protocol/carriers/turn_watch.h"
#include "protocol/message_sink.h"

namespace towbench::harness {

class PlantEnd {
 public:
  PlantEnd() = default;
  PlantEnd(const PlantEnd&) = delete;
  PlantEnd& operator=(const PlantEnd&) = delete;
  virtual ~PlantEnd() = default;

  // Where the controller's messages go.
  [[nodiscard]] virtual protocol::MessageSink& sink() noexcept = 0;
  // Who hears the plant. Must precede the first message and outlive this.
  virtual void connect(protocol::MessageSink& controller) noexcept = 0;
  // Returns when the plant has said all of its turn that ends with `expected`, or why it will not.
  [[nodiscard]] virtual core::Status wait_for(protocol::Turn expected) noexcept = 0;

  // What nobody had planned, from now on or later. False where that cannot be done: the machine is
  // in another process, or no link that could fail lies between.
  [[nodiscard]] virtual bool happen(const emulator::ScheduledEvent& /*event*/) { return false; }
  [[nodiscard]] virtual bool disturb(const LinkFault& /*fault*/) { return false; }
};

}  // namespace towbench::harness
