// A serial line as a byte stream (Boost.Asio serial_port): raw, 8 data bits, no parity, one stop
// bit, any baud rate, held by one process at a time. Frames on it are COBS (cobs.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include <boost/asio/io_context.hpp>
#include <boost/asio/serial_port.hpp>

#include "core/time.h"
#include "protocol/byte_stream.h"
#include "protocol/carriers/carrier_error.h"

namespace towbench::protocol {

// Start bit, eight data bits, stop bit.
inline constexpr unsigned kBitsPerSerialByte = 10;

class SerialPort final : public ByteStream {
 public:
  // Refuses a path that is no terminal, a port that another process holds (both the terminal's own
  // exclusive mode and a file lock are taken, because the former does not bind root), and a rate
  // that the driver does not reach within 2 %. What the line had waiting is thrown away.
  static CarrierResult<std::unique_ptr<SerialPort>> open(const std::filesystem::path& path,
                                                         std::uint32_t baud);
  ~SerialPort() override;

  // As ByteStream. A port that was unplugged is kPeerClosed from then on: open() the path again
  // when it is back.
  core::Status write(std::span<const std::byte> bytes) noexcept override;
  core::Result<std::size_t> read_some(std::span<std::byte> into,
                                      core::Nanoseconds timeout_ns) noexcept override;

  // How long write() waits for a line that takes nothing (flow control, a dead driver).
  void set_silence_limit(core::Nanoseconds limit_ns) noexcept { silence_limit_ns_ = limit_ns; }

  // The rate that the driver set.
  [[nodiscard]] std::uint32_t baud() const noexcept { return baud_; }

 private:
  SerialPort() : port_(context_) {}
  CarrierResult<void> take(const std::filesystem::path& path);
  CarrierResult<void> set_rate(const std::filesystem::path& path, std::uint32_t baud);

  boost::asio::io_context context_{1};
  boost::asio::serial_port port_;
  std::uint32_t baud_ = 0;
  core::Nanoseconds silence_limit_ns_ = core::kNanosecondsPerSecond;
};

}  // namespace towbench::protocol
