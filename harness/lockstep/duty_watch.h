// Listens on the wire and notes when the last drive goes: evidence of the controller's reaction
// that neither side has written itself.
#pragma once

#include <algorithm>

#include "core/axis.h"
#include "harness/lockstep/bench_recorder.h"
#include "protocol/message_sink.h"

namespace towbench::harness {

class DutyWatch final : public protocol::MessageSink {
 public:
  // May be null: nothing is recorded. The recorder outlives this.
  explicit DutyWatch(BenchRecorder* recorder) noexcept : recorder_(recorder) {}

  using MessageSink::on;
  void on(const protocol::PwmDuty& duty) noexcept override {
    driven_[duty.axis] = duty.enable && (duty.channel_a_ticks != 0 || duty.channel_b_ticks != 0);
  }
  // Ends the messages of a moment, which is `now_ns` of the exchange before it.
  void on(const protocol::Advance& advance) noexcept override {
    const bool driven = std::any_of(driven_.begin(), driven_.end(), [](bool axis) { return axis; });
    if (driven != was_driven_ && recorder_ != nullptr) {
      recorder_->wire_event(now_ns_, driven ? "duty_on" : "duty_zero");
    }
    was_driven_ = driven;
    now_ns_ = advance.until_ns;
    driven_until_ns_ = driven ? now_ns_ : driven_until_ns_;
  }
  // How long nothing has been driven, as of the last Advance.
  [[nodiscard]] core::Nanoseconds undriven_ns() const noexcept {
    return now_ns_ - driven_until_ns_;
  }

 private:
  BenchRecorder* recorder_;
  core::PerAxis<bool> driven_;
  bool was_driven_ = false;
  core::Nanoseconds now_ns_ = 0;
  core::Nanoseconds driven_until_ns_ = 0;
};

}  // namespace towbench::harness
