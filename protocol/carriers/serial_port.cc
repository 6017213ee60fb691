#include "protocol/carriers/serial_port.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include "protocol/carriers/serial_baud.h"

namespace towbench::protocol {
namespace {

using Clock = std::chrono::steady_clock;

CarrierResult<void> refuse(const std::filesystem::path& path, const std::string& why) {
  return carrier_failure(core::ErrorCode::kTransportFailed, path.string() + ": " + why);
}

// poll() in whole milliseconds, rounded up so that a wait never ends early.
int poll_timeout_ms(core::Nanoseconds timeout_ns) noexcept {
  const auto up = timeout_ns + core::kNanosecondsPerMillisecond - 1;
  return static_cast<int>(std::max<core::Nanoseconds>(up / core::kNanosecondsPerMillisecond, 0));
}

// Asio opens the port in raw mode, without a controlling terminal, and non-blocking.

// A port whose device is gone reads as end of file, or fails in one of these ways.
bool is_unplugged(int error) noexcept {
  return error == EIO || error == ENXIO || error == ENODEV || error == EBADF;
}

bool may_try_again(int error) noexcept {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

core::ErrorCode code_of(int error) noexcept {
  return is_unplugged(error) ? core::ErrorCode::kPeerClosed : core::ErrorCode::kTransportFailed;
}

}  // namespace

CarrierResult<std::unique_ptr<SerialPort>> SerialPort::open(const std::filesystem::path& path,
                                                            std::uint32_t baud) {
  std::unique_ptr<SerialPort> port(new SerialPort);
  boost::system::error_code error;
  port->port_.open(path.string(), error);
  if (error) {
    return carrier_failure(core::ErrorCode::kTransportFailed,
                           path.string() + ": " + error.message());
  }
  const auto set_up = port->take(path).and_then([&] { return port->set_rate(path, baud); });
  if (!set_up) {
    return tl::unexpected<CarrierError>(set_up.error());
  }
  ::tcflush(port->port_.native_handle(), TCIOFLUSH);
  return port;
}

CarrierResult<void> SerialPort::take(const std::filesystem::path& path) {
  const int descriptor = port_.native_handle();
  if (::isatty(descriptor) == 0) {
    return refuse(path, "is not a serial port");
  }
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 || ::ioctl(descriptor, TIOCEXCL) != 0) {
    return refuse(path, "another process holds the port");
  }
  ::fcntl(descriptor, F_SETFD, FD_CLOEXEC);  // or a child would keep the port taken
  return {};
}

CarrierResult<void> SerialPort::set_rate(const std::filesystem::path& path, std::uint32_t baud) {
  const auto actual = set_any_baud(port_.native_handle(), baud);
  constexpr std::uint32_t kTolerancePercent = 2;  // half of what a UART frame bears at either end
  if (!actual) {
    return refuse(path, "the driver refuses " + std::to_string(baud) + " baud");
  }
  const std::uint32_t off = std::max(*actual, baud) - std::min(*actual, baud);
  if (baud == 0 || std::uint64_t{off} * 100 > std::uint64_t{baud} * kTolerancePercent) {
    return refuse(path, "the driver makes " + std::to_string(*actual) + " of " +
                            std::to_string(baud) + " baud");
  }
  baud_ = *actual;
  return {};
}

SerialPort::~SerialPort() {
  if (port_.is_open()) {
    ::ioctl(port_.native_handle(),
            TIOCNXCL);  // the mode outlives us where others hold the line open
  }
}

core::Status SerialPort::write(std::span<const std::byte> bytes) noexcept {
  const int descriptor = port_.native_handle();
  const auto deadline = Clock::now() + std::chrono::nanoseconds(silence_limit_ns_);
  while (!bytes.empty()) {
    const ssize_t sent = ::write(descriptor, bytes.data(), bytes.size());
    if (sent >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(sent));
      continue;
    }
    if (!may_try_again(errno)) {
      return core::failure(code_of(errno));
    }
    const auto left = std::chrono::nanoseconds(deadline - Clock::now());
    if (left.count() <= 0) {
      return core::failure(core::ErrorCode::kPeerSilent);
    }
    pollfd waiting{descriptor, POLLOUT, 0};
    ::poll(&waiting, 1, poll_timeout_ms(left.count()));
  }
  return {};
}

core::Result<std::size_t> SerialPort::read_some(std::span<std::byte> into,
                                                core::Nanoseconds timeout_ns) noexcept {
  const int descriptor = port_.native_handle();
  pollfd waiting{descriptor, POLLIN, 0};
  if (::poll(&waiting, 1, poll_timeout_ms(timeout_ns)) <= 0) {
    return 0U;
  }
  const ssize_t received = ::read(descriptor, into.data(), into.size());
  if (received > 0) {
    return static_cast<std::size_t>(received);
  }
  if (received < 0 && may_try_again(errno)) {
    return 0U;
  }
  // Readable without a byte: the line has hung up.
  return core::failure(received == 0 ? core::ErrorCode::kPeerClosed : code_of(errno));
}

}  // namespace towbench::protocol
