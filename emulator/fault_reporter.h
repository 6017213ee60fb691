// Tells both sides what is wrong: the observer's record and the controller. A peer that babbles
// gets a bounded number of answers per exchange, and so does the record.
#pragma once

#include <cstdint>

#include "core/realtime.h"
#include "emulator/plant_node.h"
#include "protocol/message_sink.h"

namespace towbench::emulator {

class FaultReporter {
 public:
  explicit FaultReporter(PlantObserver& observer) noexcept : observer_(&observer) {}

  void connect(protocol::MessageSink& controller) noexcept { controller_ = &controller; }
  void begin_exchange() noexcept { in_exchange_ = 0; }

  TOWBENCH_REALTIME void report(core::Nanoseconds now_ns, core::ErrorCode code, core::Axis axis,
                                std::uint32_t detail) noexcept {
    if (in_exchange_ == kMaxPerExchange) {
      return;
    }
    ++in_exchange_;
    observer_->on_event(
        {.time_ns = now_ns, .kind = PlantEventKind::kFault, .axis = axis, .code = code});
    controller_->on(protocol::Fault{.code = code, .time_ns = now_ns, .detail = detail});
  }

 private:
  static constexpr std::uint32_t kMaxPerExchange = 16;

  PlantObserver* observer_;
  protocol::MessageSink* controller_ = nullptr;
  std::uint32_t in_exchange_ = 0;
};

}  // namespace towbench::emulator
