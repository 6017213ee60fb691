// The back-end of each driver on the registers of an AM335x.
//
// Time on the board: the pace timer overflows once an exchange; the exchange's number times its
// length is the nominal time of its service, and the timer's counter tells how long ago that was.
#pragma once

#include <array>
#include <cstdint>

#include "bbmc/baremetal/line_edges.h"
#include "bbmc/device/device_manager.h"
#include "core/axis.h"
#include "core/time.h"

namespace towbench::bbmc {

// The pace timer calls; a free-running timer tells how often it should have been heard. The console
// holds the call back while it serves a request: an exchange that passed meanwhile is served late,
// not left out, as on a host by the wall clock.
class PaceClock {
 public:
  // Takes effect with the next start.
  void set_exchange(core::Nanoseconds exchange_ns) noexcept { exchange_ns_ = exchange_ns; }
  void start() noexcept;
  // In the timer's interrupt: how many exchanges have begun and were not ticked.
  [[nodiscard]] std::uint32_t begun() const noexcept;
  // One of them is served now.
  void tick() noexcept;
  [[nodiscard]] core::Nanoseconds service_ns() const noexcept { return service_ns_; }
  [[nodiscard]] core::Nanoseconds now_ns() const noexcept;

 private:
  core::Nanoseconds exchange_ns_ = core::kNanosecondsPerMillisecond;
  core::Nanoseconds running_exchange_ns_ = core::kNanosecondsPerMillisecond;
  core::Nanoseconds service_ns_ = 0;
  std::uint32_t ticks_ = 24'000;    // of one exchange
  std::uint32_t service_tick_ = 0;  // of the free timer, at service_ns_; it wraps
  bool started_ = false;
};

class RegisterPwm final : public EhrpwmPort {
 public:
  void attach(core::Axis axis, LineEdges& edges) noexcept;
  core::Status apply(const Ehrpwm::Settings& settings) noexcept override;
  core::Status read(Ehrpwm::Reading& reading) noexcept override;
  core::Status write(const Ehrpwm::Command& command) noexcept override;
  void release() noexcept override;

 private:
  std::uint32_t base_ = 0;
  LineEdges* edges_ = nullptr;
  Ehrpwm::Command output_;
};

class RegisterEqep final : public EqepPort {
 public:
  void attach(core::Axis axis, const PaceClock& clock) noexcept;
  core::Status apply(const Eqep::Settings& settings) noexcept override;
  core::Status read(Eqep::Reading& reading) noexcept override;
  core::Status write(const Eqep::Command& command) noexcept override;
  void release() noexcept override {}

 private:
  void read_capture(std::uint32_t counted) noexcept;
  void read_flags() noexcept;

  std::uint32_t base_ = 0;
  const PaceClock* clock_ = nullptr;
  Eqep::Reading last_;
  bool moved_ = false;       // an edge has been seen since the start
  bool overflowed_ = false;  // the capture timer has, since the last edge
};

class RegisterTimer final : public DmtimerPort {
 public:
  explicit RegisterTimer(PaceClock& clock) noexcept : clock_(&clock) {}
  core::Status apply(const Dmtimer::Settings& settings) noexcept override;
  core::Status read(Dmtimer::Reading& reading) noexcept override;
  core::Status write(const Dmtimer::Command& command) noexcept override;
  void release() noexcept override { running_ = false; }

 private:
  PaceClock* clock_;
  core::Nanoseconds period_ns_ = core::kNanosecondsPerMillisecond;
  core::Nanoseconds next_due_ns_ = 0;
  std::uint64_t ticks_ = 0;
  bool running_ = false;
};

class RegisterLine final : public GpioPort {
 public:
  void attach(Line line) noexcept;
  core::Status apply(const Gpio::Settings& settings) noexcept override;
  core::Status read(Gpio::Reading& reading) noexcept override;
  core::Status write(const Gpio::Command& command) noexcept override;
  void release() noexcept override;

 private:
  std::uint32_t mask_ = 0;
  bool urgent_ = false;
  bool output_ = false;
};

class RegisterInterrupts final : public AintcPort {
 public:
  explicit RegisterInterrupts(LineEdges& edges) noexcept : edges_(&edges) {}
  core::Status apply(const Aintc::Settings& settings) noexcept override;
  core::Status read(Aintc::Reading& reading) noexcept override;
  core::Status write(const Aintc::Command& command) noexcept override;
  void release() noexcept override {}

 private:
  LineEdges* edges_;
  std::uint8_t threshold_ = 0xFF;
  std::uint16_t masked_ = 0;
};

// A ring in memory between the console and the UART's FIFO.
class RegisterUart final : public UartPort {
 public:
  core::Status apply(const Uart::Settings& settings) noexcept override;
  core::Status read(Uart::Reading& reading) noexcept override;
  core::Status write(const Uart::Command& command) noexcept override;
  void release() noexcept override {}

  // Moves what fits into the FIFO.
  void feed() noexcept;
  [[nodiscard]] bool all_fed() const noexcept { return fed_ == written_; }
  [[nodiscard]] static bool has_input() noexcept;

 private:
  static constexpr std::uint32_t kRing = 16384;
  std::array<char, kRing> ring_{};
  std::uint32_t written_ = 0;
  std::uint32_t fed_ = 0;
};

}  // namespace towbench::bbmc
