// The controller's end of the protocol: the emulated board (drivers' back-ends fed by messages)
// with the three layers of BBMC on it.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "bbmc/host/quadrature_decoder.h"
#include "bbmc/system/configuration.h"
#include "bbmc/system/system_event.h"
#include "bbmc/system/telemetry_row.h"
#include "core/result.h"
#include "core/time.h"
#include "protocol/message_sink.h"

namespace towbench::bbmc {

using ControllerEvent = SystemEvent;

class ControllerNode : public protocol::MessageSink {
 public:
  explicit ControllerNode(const Configuration& configuration, std::uint64_t fixture_hash = 0);
  ~ControllerNode() override;

  // Must precede everything else. The sink outlives this node.
  void connect(protocol::MessageSink& plant) noexcept;

  // Sends Hello. The answer arrives as HelloReply before the first serve().
  void greet() noexcept;
  // Whether the plant agreed; kPeerSilent while no reply has come.
  [[nodiscard]] core::Status handshake() const noexcept;

  using MessageSink::on;
  void on(const protocol::HelloReply& reply) noexcept override;
  void on(const protocol::EncoderEdges& edges) noexcept override;
  void on(const protocol::EncoderReport& report) noexcept override;
  void on(const protocol::DigitalInputs& inputs) noexcept override;
  void on(const protocol::ForceSample& sample) noexcept override;
  void on(const protocol::CurrentSample& sample) noexcept override;
  void on(const protocol::Advanced& advanced) noexcept override;
  void on(const protocol::Fault& fault) noexcept override;
  void on(const protocol::Bye& bye) noexcept override;

  // Serves interrupts, the control tick if one is due, and the console, as of `now_ns`; what it
  // wants of the plant has been sent when it returns. Called once an exchange, in order.
  void serve(core::Nanoseconds now_ns) noexcept;

  // Fixed by the configuration: 1 ms or the control period, whichever is shorter.
  [[nodiscard]] core::Nanoseconds exchange_ns() const noexcept;

  // The time of the last Advanced received; serve() up to here.
  [[nodiscard]] core::Nanoseconds plant_time_ns() const noexcept;

  // Bytes to and from the console's UART. type() returns how many the UART took.
  std::size_t type(std::string_view bytes) noexcept;
  [[nodiscard]] std::size_t read_console(std::span<char> into) noexcept;

  // False when none is waiting. Rows and events are never dropped silently: `rows_lost()` counts.
  [[nodiscard]] bool next_row(TelemetryRow& row) noexcept;
  [[nodiscard]] bool next_event(ControllerEvent& event) noexcept;
  [[nodiscard]] std::uint64_t rows_lost() const noexcept;
  // Of an axis' encoder, as far as it has been heard.
  [[nodiscard]] EdgeTimes edge_times(core::Axis axis) const noexcept;

  // True when no motion runs and the console has nothing left to do: what a script waits for.
  [[nodiscard]] bool idle() const noexcept;
  // True after `quit`.
  [[nodiscard]] bool quit_requested() const noexcept;

  // The carrier calls this when the plant is gone: the drive is zeroed and a fault latched.
  void peer_lost(core::ErrorCode why) noexcept;
  // Orderly end: zero duty, disable, Bye.
  void say_bye() noexcept;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace towbench::bbmc
