// A board whose peripherals are fed by protocol messages: the back-ends behind BBMC's drivers when
// the other side of the wire is a plant emulator.
//
// Messages are taken as they come; time stands still between two calls of set_time().
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "bbmc/device/axes.h"
#include "bbmc/device/device_manager.h"
#include "bbmc/host/emulated_ports.h"
#include "core/time.h"
#include "protocol/message_sink.h"

namespace towbench::bbmc {

class EmulatedBoard {
 public:
  EmulatedBoard() noexcept;
  EmulatedBoard(const EmulatedBoard&) = delete;
  EmulatedBoard& operator=(const EmulatedBoard&) = delete;
  ~EmulatedBoard() = default;

  [[nodiscard]] BoardPorts ports() noexcept;

  // False when a message before this one is missing.
  TOWBENCH_REALTIME [[nodiscard]] bool take(const protocol::EncoderEdges& edges) noexcept;
  TOWBENCH_REALTIME [[nodiscard]] bool take(const protocol::EncoderReport& report) noexcept;
  TOWBENCH_REALTIME [[nodiscard]] bool take(const protocol::DigitalInputs& inputs) noexcept;

  // Interrupts up to `now_ns` become pending, timers run to it.
  void set_time(core::Nanoseconds now_ns) noexcept { clock_.now_ns = now_ns; }

  // Sends what was written since the last call.
  TOWBENCH_REALTIME void flush(protocol::MessageSink& plant) noexcept;

  [[nodiscard]] EmulatedUart& console() noexcept { return console_; }
  [[nodiscard]] const QuadratureDecoder& decoder(core::Axis axis) const noexcept {
    return encoder_[axis].decoder();
  }

 private:
  BoardClock clock_;
  LineBank lines_;
  PerAxis<EmulatedPwm> pwm_;
  PerAxis<EmulatedEqep> encoder_;
  EmulatedTimer timer_{clock_};
  EmulatedInterrupts interrupts_{clock_, lines_};
  std::array<EmulatedLine, kLineCount> line_ports_;
  EmulatedUart console_;
  PerAxis<std::uint32_t> pwm_sequence_;
  std::uint32_t outputs_sequence_ = 0;
  std::uint32_t next_inputs_sequence_ = 0;
  bool inputs_started_ = false;
};

}  // namespace towbench::bbmc
