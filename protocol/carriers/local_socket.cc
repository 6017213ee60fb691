#include "protocol/carriers/local_socket.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <string>

#include <boost/asio/local/connect_pair.hpp>
#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace towbench::protocol {
namespace {

using Clock = std::chrono::steady_clock;

// To block and to be woken takes longer than a peer on another core needs for its answer.
constexpr core::Nanoseconds kSpin_ns = 80 * core::kNanosecondsPerMicrosecond;
constexpr int kMostWithout = 1024;  // reads that do not spin, after spins in vain

bool has_several_cores() noexcept {
  cpu_set_t cores;
  return ::sched_getaffinity(0, sizeof cores, &cores) == 0 && CPU_COUNT(&cores) > 1;
}

// poll() in whole milliseconds, rounded up so that a wait never ends early.
int poll_timeout_ms(core::Nanoseconds timeout_ns) noexcept {
  const auto rounded = (timeout_ns + core::kNanosecondsPerMillisecond - 1);
  return static_cast<int>(rounded / core::kNanosecondsPerMillisecond);
}

core::ErrorCode code_of(int error) noexcept {
  return error == EPIPE || error == ECONNRESET ? core::ErrorCode::kPeerClosed
                                               : core::ErrorCode::kTransportFailed;
}

// While a server starts up there is no socket, or one on which nobody listens yet.
bool may_still_appear(const boost::system::error_code& error) noexcept {
  return error == boost::system::errc::no_such_file_or_directory ||
         error == boost::system::errc::connection_refused;
}

}  // namespace

std::filesystem::path default_socket_directory() {
  // Read once at start-up, before any thread exists.
  if (const char* runtime = std::getenv("XDG_RUNTIME_DIR");  // NOLINT(concurrency-mt-unsafe)
      runtime != nullptr && *runtime != '\0') {
    return std::filesystem::path(runtime) / "towbench";
  }
  return std::filesystem::temp_directory_path() / ("towbench-" + std::to_string(::geteuid()));
}

LocalSocket::LocalSocket() : socket_(context_), spins_(has_several_cores()) {}

CarrierResult<std::unique_ptr<LocalSocket>> LocalSocket::connect(const std::filesystem::path& path,
                                                                 core::Nanoseconds timeout_ns) {
  if (path.native().size() >= sizeof(sockaddr_un::sun_path)) {
    return carrier_failure(core::ErrorCode::kTransportFailed,
                           "socket path is too long: " + path.string());
  }
  const auto deadline = Clock::now() + std::chrono::nanoseconds(timeout_ns);
  std::unique_ptr<LocalSocket> end(new LocalSocket);
  boost::system::error_code error;
  do {
    end->socket_.connect(Protocol::endpoint(path.string()), error);
    if (!error) {
      end->keep_from_children();
      return end;
    }
    end->socket_.close();
    if (may_still_appear(error)) {
      constexpr int kRetry_ms = 5;
      ::poll(nullptr, 0, kRetry_ms);
    }
  } while (may_still_appear(error) && Clock::now() < deadline);
  return carrier_failure(
      may_still_appear(error) ? core::ErrorCode::kPeerSilent : core::ErrorCode::kTransportFailed,
      "cannot connect to " + path.string() + ": " + error.message());
}

CarrierResult<std::unique_ptr<LocalSocket>> LocalSocket::adopt(int descriptor) {
  std::unique_ptr<LocalSocket> end(new LocalSocket);
  boost::system::error_code error;
  end->socket_.assign(Protocol(), descriptor, error);
  if (error) {
    return carrier_failure(
        core::ErrorCode::kTransportFailed,
        "cannot use descriptor " + std::to_string(descriptor) + ": " + error.message());
  }
  end->keep_from_children();
  return end;
}

CarrierResult<std::pair<std::unique_ptr<LocalSocket>, std::unique_ptr<LocalSocket>>>
LocalSocket::pair() {
  std::unique_ptr<LocalSocket> a(new LocalSocket);
  std::unique_ptr<LocalSocket> b(new LocalSocket);
  boost::system::error_code error;
  boost::asio::local::connect_pair(a->socket_, b->socket_, error);
  if (error) {
    return carrier_failure(core::ErrorCode::kTransportFailed,
                           "cannot make a socket pair: " + error.message());
  }
  a->keep_from_children();
  b->keep_from_children();
  return std::pair(std::move(a), std::move(b));
}

void LocalSocket::keep_from_children() noexcept {
  ::fcntl(socket_.native_handle(), F_SETFD, FD_CLOEXEC);  // cannot fail on an open descriptor
}

core::Status LocalSocket::write(std::span<const std::byte> bytes) noexcept {
  while (!bytes.empty()) {
    const ssize_t sent =
        ::send(socket_.native_handle(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(sent));
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      if (!wait_until_writable()) {
        return core::failure(core::ErrorCode::kPeerSilent);
      }
    } else if (errno != EINTR) {
      return core::failure(code_of(errno));
    }
  }
  return {};
}

bool LocalSocket::wait_until_writable() noexcept {
  pollfd waiting{socket_.native_handle(), POLLOUT, 0};
  const auto deadline = Clock::now() + std::chrono::nanoseconds(silence_limit_ns_);
  for (auto left = deadline - Clock::now(); left.count() > 0; left = deadline - Clock::now()) {
    // A hang-up also wakes the wait; the next send names it.
    if (::poll(&waiting, 1, poll_timeout_ms(left.count())) > 0) {
      return true;
    }
  }
  return false;
}

core::Result<std::size_t> LocalSocket::read_some(std::span<std::byte> into,
                                                 core::Nanoseconds timeout_ns) noexcept {
  const int flags = timeout_ns <= 0 ? MSG_DONTWAIT : 0;
  if (flags == 0 && timeout_ns != receive_timeout_ns_ && !set_receive_timeout(timeout_ns)) {
    return core::failure(core::ErrorCode::kTransportFailed);
  }
  ssize_t received = flags == 0 && spins_ ? spin(into, timeout_ns) : -1;
  if (received < 0) {
    received = ::recv(socket_.native_handle(), into.data(), into.size(), flags);
  }
  if (received > 0) {
    return static_cast<std::size_t>(received);
  }
  if (received == 0) {
    return into.empty() ? core::Result<std::size_t>(0U)
                        : core::failure(core::ErrorCode::kPeerClosed);
  }
  if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) {
    return 0U;
  }
  return core::failure(code_of(errno));
}

// As recv() without blocking; -1 where nothing has come. Each spin in vain doubles how many reads
// then go without one.
ssize_t LocalSocket::spin(std::span<std::byte> into, core::Nanoseconds timeout_ns) noexcept {
  if (--reads_left_ > 0) {
    return -1;
  }
  const auto end = Clock::now() + std::chrono::nanoseconds(std::min(kSpin_ns, timeout_ns));
  ssize_t received = -1;
  do {
    received = ::recv(socket_.native_handle(), into.data(), into.size(), MSG_DONTWAIT);
  } while (received < 0 && errno == EAGAIN && Clock::now() < end);
  reads_without_ = received >= 0 ? 1 : std::min(2 * reads_without_, kMostWithout);
  reads_left_ = reads_without_;
  return received;
}

bool LocalSocket::set_receive_timeout(core::Nanoseconds timeout_ns) noexcept {
  // A timeout of zero would mean for ever.
  const auto us = std::max<core::Nanoseconds>(timeout_ns / core::kNanosecondsPerMicrosecond, 1);
  constexpr core::Nanoseconds kMicrosecondsPerSecond = 1'000'000;
  const timeval timeout{static_cast<time_t>(us / kMicrosecondsPerSecond),
                        static_cast<suseconds_t>(us % kMicrosecondsPerSecond)};
  receive_timeout_ns_ = timeout_ns;
  return ::setsockopt(socket_.native_handle(), SOL_SOCKET, SO_RCVTIMEO, &timeout,
                      sizeof(timeout)) == 0;
}

void LocalSocket::close() noexcept {
  boost::system::error_code ignored;  // already closed by the peer, then
  socket_.shutdown(Protocol::socket::shutdown_both, ignored);
}

}  // namespace towbench::protocol
