// One raw socket on a SocketCAN interface: can0, vcan0.
//
// The kernel passes on only the identifiers that this side listens to, and error frames. FD frames
// are sent and taken where they are asked for. Otherwise, where the interface has them, the socket
// takes FD frames too, so that a node that sends them disturbs nobody: they are counted and
// ignored.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "protocol/carriers/can_layout.h"
#include "protocol/carriers/can_port.h"
#include "protocol/carriers/carrier_error.h"

namespace towbench::protocol {

// What the bus and the kernel told.
struct CanBusCounts {
  std::uint64_t error_frames = 0;    // of any kind, those below included
  std::uint64_t bus_off = 0;         // the controller left the bus
  std::uint64_t restarts = 0;        // and came back (ip link: restart-ms)
  std::uint64_t error_passive = 0;   // warning level or worse
  std::uint64_t no_acknowledge = 0;  // nobody else on the bus
  std::uint64_t dropped = 0;         // received, and lost because this process was too slow
  std::uint64_t queue_full = 0;      // times that a frame had to wait for room in the send queue
  std::uint64_t fd_frames = 0;       // received and ignored
  std::uint64_t foreign_frames = 0;  // extended or remote: nobody of ours sends such
  friend bool operator==(const CanBusCounts&, const CanBusCounts&) = default;
};

// Whether this interface of the host is a program's (vcan) and no controller's; false also when
// there is none of this name.
[[nodiscard]] bool is_virtual_can(const std::string& interface);

class SocketCan final : public CanPort {
 public:
  // `heard` is the direction of the frames that are to be received. Refused, in words that name the
  // interface: no CAN in this kernel, no such interface, not a CAN interface, not up, no
  // FD where it is asked for.
  static CarrierResult<std::unique_ptr<SocketCan>> open(const std::string& interface,
                                                        CanDirection heard, bool with_fd = false);
  ~SocketCan() override;

  [[nodiscard]] bool carries_fd() const noexcept override { return with_fd_; }
  // As CanPort. Bus-off ends this socket with kTransportFailed, whatever the interface does then:
  // the run is lost, both sides are in their safe state, and a new run opens the bus anew.
  core::Status send(std::span<const CanFrame> frames) noexcept override;
  core::Result<std::size_t> receive(std::span<CanFrame> into,
                                    core::Nanoseconds timeout_ns) noexcept override;

  // How long send() waits for room in a queue that stays full.
  void set_silence_limit(core::Nanoseconds limit_ns) noexcept { silence_limit_ns_ = limit_ns; }

  [[nodiscard]] const CanBusCounts& counts() const noexcept { return counts_; }
  [[nodiscard]] bool has_fd() const noexcept { return has_fd_; }

 private:
  explicit SocketCan(int descriptor) noexcept : descriptor_(descriptor) {}
  CarrierResult<void> bind_to(const std::string& interface);
  [[nodiscard]] bool set_options(CanDirection heard) noexcept;
  [[nodiscard]] bool set_receive_timeout(core::Nanoseconds timeout_ns) noexcept;
  void note_error(std::uint32_t classes, const std::uint8_t* data) noexcept;

  int descriptor_;
  bool has_fd_ = false;
  bool with_fd_ = false;
  bool is_bus_off_ = false;
  core::Nanoseconds silence_limit_ns_ = core::kNanosecondsPerSecond;
  core::Nanoseconds receive_timeout_ns_ = 0;
  std::uint32_t last_dropped_ = 0;
  CanBusCounts counts_;
};

}  // namespace towbench::protocol
