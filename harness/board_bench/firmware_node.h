// The controller's end of the protocol when the controller is an image on the virtual board:
// messages become signals at the board's pins, and what the pins say becomes messages.
#pragma once

#include <cstdint>

#include "board/board.h"
#include "core/result.h"
#include "harness/experiment/board_wiring.h"
#include "protocol/message_sink.h"

namespace towbench::harness {

class FirmwareNode final : public protocol::MessageSink {
 public:
  // All outlive this. `axes_mask` of the machine.
  FirmwareNode(board::Board& board, const BoardWiring& wiring, std::uint8_t axes_mask,
               std::uint64_t fixture_hash) noexcept
      : board_(board), wiring_(wiring), axes_mask_(axes_mask), hash_(fixture_hash) {}

  void connect(protocol::MessageSink& plant) noexcept { plant_ = &plant; }
  void greet() noexcept;
  [[nodiscard]] core::Status handshake() const noexcept { return agreed_; }

  using MessageSink::on;
  void on(const protocol::HelloReply& reply) noexcept override;
  void on(const protocol::EncoderEdges& edges) noexcept override;
  void on(const protocol::DigitalInputs& inputs) noexcept override;
  void on(const protocol::Advanced& advanced) noexcept override { plant_ns_ = advanced.time_ns; }

  // Sends what the pins say now, where it has changed.
  void send_outputs() noexcept;
  // Zero duty, amplifiers off, Bye.
  void say_bye() noexcept;

  [[nodiscard]] core::Nanoseconds plant_time_ns() const noexcept { return plant_ns_; }
  [[nodiscard]] bool drives() const noexcept;
  // As last sent; positive towards the maximum.
  [[nodiscard]] double duty_pct(core::Axis axis) const noexcept;

 private:
  struct Drive {
    bool enable = false;
    std::uint16_t a = 0;
    std::uint16_t b = 0;
    std::uint16_t period = 1;
    friend bool operator==(const Drive&, const Drive&) = default;
  };

  [[nodiscard]] Drive drive_of(core::Axis axis) noexcept;
  void send(core::Axis axis, const Drive& drive) noexcept;
  void drive_pin(const std::optional<BoardPin>& pin, bool active, core::Nanoseconds time_ns);
  [[nodiscard]] bool output_of(const BoardPin& pin) const;

  board::Board& board_;
  const BoardWiring& wiring_;
  std::uint8_t axes_mask_;
  std::uint64_t hash_;
  protocol::MessageSink* plant_ = nullptr;
  core::Status agreed_ = core::failure(core::ErrorCode::kPeerSilent);
  core::Nanoseconds plant_ns_ = 0;
  core::PerPlanarAxis<Drive> sent_;
  core::PerPlanarAxis<std::uint32_t> duty_sequence_;
  core::PerPlanarAxis<bool> encoder_known_;
  std::uint16_t outputs_ = 0;
  std::uint32_t outputs_sequence_ = 0;
  bool anything_sent_ = false;
  bool ended_ = false;
};

}  // namespace towbench::harness
