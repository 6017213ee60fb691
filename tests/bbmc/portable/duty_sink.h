// Writes every duty that the controller sends, and hands it on to the machine where there is one.
#pragma once

#include <bit>
#include <cstdint>
#include <cstdio>

#include "bbmc/host/emulated_board.h"
#include "protocol/message_sink.h"
#include "tests/bbmc/portable/script.h"

namespace towbench::portable {

class DutySink final : public protocol::MessageSink {
 public:
  DutySink(std::FILE* file, protocol::MessageSink* machine) : file_(file), machine_(machine) {}
  using MessageSink::on;
  void on(const protocol::PwmDuty& duty) noexcept override {
    std::fprintf(file_, "%d %d %u %u %u %u\n", static_cast<int>(duty.axis), duty.enable ? 1 : 0,
                 static_cast<unsigned>(duty.channel_a_ticks),
                 static_cast<unsigned>(duty.channel_b_ticks),
                 static_cast<unsigned>(duty.period_ticks), static_cast<unsigned>(duty.sequence));
    if (machine_ != nullptr) {
      machine_->on(duty);
    }
  }
  void on(const protocol::DigitalOutputs& outputs) noexcept override {
    if (machine_ != nullptr) {
      machine_->on(outputs);
    }
  }
  // The controller's own figures to the last bit, beside the duty that is rounded to ticks.
  void figures(const bbmc::TelemetryRow& row) noexcept {
    for (const core::Axis axis : core::kPlanarAxes) {
      const auto& state = row.axes[axis];
      std::fputs("r", file_);
      for (const double figure : {state.reference_m, state.velocity_m_per_s, state.duty_pct}) {
        // As bits: bare metal's printf knows no %a.
        const auto bits = std::bit_cast<std::uint64_t>(figure);
        std::fprintf(file_, " %08x%08x", static_cast<unsigned>(bits >> 32U),
                     static_cast<unsigned>(bits));
      }
      std::fputs("\n", file_);
    }
  }

 private:
  std::FILE* file_;
  protocol::MessageSink* machine_;
};

// One exchange: what is asked, what is served, what goes out.
inline bool serve(bbmc::EmulatedBoard& board, bbmc::SystemManager& system, long exchange,
                  DutySink& sink) {
  const bool accepted = ask(system, exchange);
  const core::Nanoseconds now_ns = exchange * core::kNanosecondsPerMillisecond;
  board.set_time(now_ns);
  system.service(now_ns);
  board.flush(sink);
  bbmc::TelemetryRow row;
  while (system.next_row(row)) {
    sink.figures(row);
  }
  bbmc::SystemEvent event;
  while (system.next_event(event)) {
  }
  return accepted;
}

}  // namespace towbench::portable
