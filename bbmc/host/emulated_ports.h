// The back-end of each driver on the emulated board.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "bbmc/device/aintc.h"
#include "bbmc/device/dmtimer.h"
#include "bbmc/device/ehrpwm.h"
#include "bbmc/device/eqep.h"
#include "bbmc/device/gpio.h"
#include "bbmc/device/uart.h"
#include "bbmc/host/quadrature_decoder.h"
#include "core/bounded_vector.h"
#include "core/spsc_queue.h"
#include "core/time.h"

namespace towbench::bbmc {

struct BoardClock {
  core::Nanoseconds now_ns = 0;
};

class EmulatedPwm final : public EhrpwmPort {
 public:
  core::Status apply(const Ehrpwm::Settings& settings) noexcept override;
  core::Status read(Ehrpwm::Reading& reading) noexcept override;
  core::Status write(const Ehrpwm::Command& command) noexcept override;
  void release() noexcept override;

  // True once after each write.
  [[nodiscard]] bool take_written() noexcept;
  [[nodiscard]] const Ehrpwm::Command& output() const noexcept { return output_; }
  [[nodiscard]] std::uint16_t period_ticks() const noexcept { return settings_.period_ticks; }

 private:
  Ehrpwm::Settings settings_;
  Ehrpwm::Command output_;
  bool written_ = false;
};

class EmulatedEqep final : public EqepPort {
 public:
  core::Status apply(const Eqep::Settings& settings) noexcept override;
  core::Status read(Eqep::Reading& reading) noexcept override;
  core::Status write(const Eqep::Command& command) noexcept override;
  void release() noexcept override {}

  [[nodiscard]] QuadratureDecoder& decoder() noexcept { return decoder_; }
  [[nodiscard]] const QuadratureDecoder& decoder() const noexcept { return decoder_; }

 private:
  QuadratureDecoder decoder_;
};

class EmulatedTimer final : public DmtimerPort {
 public:
  explicit EmulatedTimer(const BoardClock& clock) noexcept : clock_(&clock) {}
  core::Status apply(const Dmtimer::Settings& settings) noexcept override;
  core::Status read(Dmtimer::Reading& reading) noexcept override;
  core::Status write(const Dmtimer::Command& command) noexcept override;
  void release() noexcept override { running_ = false; }

 private:
  const BoardClock* clock_;
  core::Nanoseconds period_ns_ = core::kNanosecondsPerMillisecond;
  core::Nanoseconds next_due_ns_ = 0;
  std::uint64_t ticks_ = 0;
  bool running_ = false;
};

// Levels of all lines and the edges that nobody has served yet.
struct LineBank {
  // Bouncing lines beyond that are seen by their level; the kill switch never waits in the queue's
  // tail, because it is inserted by time and priority and the least urgent edge makes room.
  static constexpr std::size_t kMaxPending = 128;

  std::uint16_t levels = 0;
  std::uint16_t interrupts_enabled = 0;
  bool outputs_written = false;
  std::uint64_t edges_dropped = 0;
  // Sorted: next to serve last, so that serving is a pop.
  std::array<Aintc::Reading, kMaxPending> pending{};
  std::size_t pending_count = 0;

  void insert(const Aintc::Reading& edge) noexcept;
};

class EmulatedLine final : public GpioPort {
 public:
  EmulatedLine() noexcept = default;
  void attach(LineBank& bank, Line line) noexcept {
    bank_ = &bank;
    mask_ = static_cast<std::uint16_t>(1U << index_of(line));
  }
  core::Status apply(const Gpio::Settings& settings) noexcept override;
  core::Status read(Gpio::Reading& reading) noexcept override;
  core::Status write(const Gpio::Command& command) noexcept override;
  void release() noexcept override;

 private:
  LineBank* bank_ = nullptr;
  std::uint16_t mask_ = 0;
  bool output_ = false;
};

class EmulatedInterrupts final : public AintcPort {
 public:
  EmulatedInterrupts(const BoardClock& clock, LineBank& bank) noexcept
      : clock_(&clock), bank_(&bank) {}
  core::Status apply(const Aintc::Settings& settings) noexcept override;
  core::Status read(Aintc::Reading& reading) noexcept override;
  core::Status write(const Aintc::Command& command) noexcept override;
  void release() noexcept override {}

 private:
  [[nodiscard]] bool served(const Aintc::Reading& edge) const noexcept;

  const BoardClock* clock_;
  LineBank* bank_;
  std::uint8_t threshold_ = 0xFF;
  std::uint16_t masked_ = 0;
};

// Two rings: the far ends may be served by another thread than the controller's.
class EmulatedUart final : public UartPort {
 public:
  core::Status apply(const Uart::Settings& settings) noexcept override;
  core::Status read(Uart::Reading& reading) noexcept override;
  core::Status write(const Uart::Command& command) noexcept override;
  void release() noexcept override {}

  // The terminal's side. type() returns how many bytes the UART took.
  std::size_t type(std::string_view bytes) noexcept;
  [[nodiscard]] std::size_t read_out(std::span<char> into) noexcept;
  [[nodiscard]] bool has_input() const noexcept { return !received_.empty(); }

 private:
  core::SpscQueue<char, 4096> received_;
  core::SpscQueue<char, 16384> transmitted_;
};

}  // namespace towbench::bbmc
