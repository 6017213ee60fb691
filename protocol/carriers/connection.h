// One side's open end of any carrier, and how two sides find each other on it.
//
// The plant that waits sends a heartbeat ten times a second, and a controller that hears one greets
// it: a serial line and a bus have no connection of their own, and a process takes its time to
// start.
#pragma once

#include <functional>
#include <memory>

#include "protocol/carriers/can_link.h"
#include "protocol/carriers/carrier_address.h"
#include "protocol/carriers/carrier_error.h"
#include "protocol/carriers/paced_can.h"
#include "protocol/carriers/socket_can.h"
#include "protocol/carriers/turn_link.h"

namespace towbench::protocol {

// Bits that have crossed a wire: eight a byte on a socket, ten on a serial line, those of whole
// frames with the worst stuffing on a bus.
struct WireUse {
  std::uint64_t bits_sent = 0;
  std::uint64_t bits_received = 0;
};

class Connection {
 public:
  // As long as it says true the plant goes on waiting; asked several times a second.
  using KeepWaiting = std::function<bool()>;

  // Opens the controller's end and waits for a plant that waits. kPeerSilent when there is none.
  static CarrierResult<std::unique_ptr<Connection>> to_plant(
      const CarrierAddress& address,
      core::Nanoseconds patience_ns = 3 * core::kNanosecondsPerSecond);

  // Opens the plant's end. A local socket waits for its peer here; null when it may not go on.
  static CarrierResult<std::unique_ptr<Connection>> to_controller(const CarrierAddress& address,
                                                                  const KeepWaiting& keep_waiting);

  // A connected local stream that somebody else has made. Takes it over.
  static std::unique_ptr<Connection> over(std::unique_ptr<ByteStream> stream);

  // Controller's end: waits until the plant is heard. to_plant() has done so.
  [[nodiscard]] core::Status await_heartbeat(core::Nanoseconds patience_ns);

  // Plant's end: waits until a controller greets. kPeerSilent when it may not go on.
  [[nodiscard]] core::Result<Hello> await_hello(const KeepWaiting& keep_waiting);

  [[nodiscard]] TurnLink& link() noexcept { return *link_; }
  // Null unless this is a bus.
  [[nodiscard]] CanLink* can_link() noexcept { return can_link_; }
  [[nodiscard]] const SocketCan* bus() const noexcept { return bus_.get(); }
  [[nodiscard]] WireUse wire_use() const noexcept;

 private:
  Connection() = default;
  static CarrierResult<std::unique_ptr<Connection>> open_port(const CarrierAddress& address,
                                                              CanDirection direction);
  void make_link();

  bool is_local_ = false;
  CanDirection direction_ = CanDirection::kToPlant;
  std::unique_ptr<ByteStream> stream_;
  std::unique_ptr<SocketCan> bus_;
  HostWireClock wire_clock_;
  std::unique_ptr<PacedCan> paced_bus_;  // null: the bus has a rate of its own, or none
  std::unique_ptr<TurnLink> link_;
  CanLink* can_link_ = nullptr;
};

}  // namespace towbench::protocol
