// Two processes of one user on one host: a local stream socket (Boost.Asio).
//
// The socket lies in a directory that only its owner may enter (0700), has mode 0600 itself, and
// the peer's user is checked once more on connection. Nothing listens beyond the host.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>

#include "core/time.h"
#include "protocol/byte_stream.h"
#include "protocol/carriers/carrier_error.h"

namespace towbench::protocol {

inline constexpr core::Nanoseconds kDefaultSilence_ns = core::kNanosecondsPerSecond;

// One connected end. A turn costs one send and one receive: the waiting time is the socket's own
// (SO_RCVTIMEO), so no poll precedes the read. Before it blocks, a read spins for some
// microseconds, because a peer on another core answers sooner. SIGPIPE is never raised.
class LocalSocket final : public ByteStream {
 public:
  // Waits until a server accepts or `timeout_ns` has passed: a server that is still starting up
  // (no socket yet, or nobody listening) is tried again.
  static CarrierResult<std::unique_ptr<LocalSocket>> connect(
      const std::filesystem::path& path, core::Nanoseconds timeout_ns = kDefaultSilence_ns);

  // Takes over an inherited, connected stream socket. Closes it when destroyed. Like every other
  // end it is closed in children that this process starts: an end that lived on in one would hide
  // the death of its owner from the peer.
  static CarrierResult<std::unique_ptr<LocalSocket>> adopt(int descriptor);

  // Two ends in one process, for tests and for a forked child that keeps one.
  static CarrierResult<std::pair<std::unique_ptr<LocalSocket>, std::unique_ptr<LocalSocket>>>
  pair();

  // How long write() waits for a peer that takes nothing before kPeerSilent.
  void set_silence_limit(core::Nanoseconds limit_ns) noexcept { silence_limit_ns_ = limit_ns; }

  core::Status write(std::span<const std::byte> bytes) noexcept override;
  core::Result<std::size_t> read_some(std::span<std::byte> into,
                                      core::Nanoseconds timeout_ns) noexcept override;

  // No more will be sent; the peer reads kPeerClosed after what is under way.
  void close() noexcept;

  [[nodiscard]] int descriptor() noexcept { return socket_.native_handle(); }

 private:
  friend class LocalServer;
  using Protocol = boost::asio::local::stream_protocol;

  LocalSocket();
  void keep_from_children() noexcept;
  bool set_receive_timeout(core::Nanoseconds timeout_ns) noexcept;
  [[nodiscard]] bool wait_until_writable() noexcept;
  [[nodiscard]] ssize_t spin(std::span<std::byte> into, core::Nanoseconds timeout_ns) noexcept;

  boost::asio::io_context context_{1};
  Protocol::socket socket_;
  core::Nanoseconds silence_limit_ns_ = kDefaultSilence_ns;
  core::Nanoseconds receive_timeout_ns_ = 0;
  bool spins_;             // there is a core for the peer
  int reads_without_ = 1;  // a spin, after the last one
  int reads_left_ = 0;     // of those
};

// The end that waits. Holds a lock beside the socket for as long as it lives, so that a path is
// served once; a socket left behind by a killed server is replaced, a live one is refused.
class LocalServer {
 public:
  // Makes the directory (0700) when it is missing; refuses one that others may enter, a path longer
  // than a socket name can be, and a path at which something that is not a socket lies.
  static CarrierResult<std::unique_ptr<LocalServer>> listen(const std::filesystem::path& path);
  ~LocalServer();
  LocalServer(const LocalServer&) = delete;
  LocalServer& operator=(const LocalServer&) = delete;

  // Waits for one peer of this user. kPeerSilent when none came in time.
  CarrierResult<std::unique_ptr<LocalSocket>> accept(core::Nanoseconds timeout_ns);

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  using Protocol = boost::asio::local::stream_protocol;

  explicit LocalServer(std::filesystem::path path) : path_(std::move(path)), acceptor_(context_) {}
  CarrierResult<void> lock();
  CarrierResult<void> clear_path();
  CarrierResult<void> bind();

  std::filesystem::path path_;
  int lock_descriptor_ = -1;
  bool locked_ = false;
  bool bound_ = false;
  boost::asio::io_context context_{1};
  Protocol::acceptor acceptor_;
};

// A private directory for sockets: $XDG_RUNTIME_DIR/towbench, or towbench-<uid> in the temporary
// directory. Not created here.
[[nodiscard]] std::filesystem::path default_socket_directory();

}  // namespace towbench::protocol
