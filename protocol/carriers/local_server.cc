#include <algorithm>
#include <cerrno>
#include <chrono>
#include <string>
#include <system_error>

#include <boost/asio/error.hpp>
#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "protocol/carriers/local_socket.h"

namespace towbench::protocol {
namespace {

constexpr mode_t kOwnerOnlyDirectory = 0700;
constexpr mode_t kOwnerOnlyFile = 0600;
constexpr mode_t kOthers = 0077;

std::string reason(int error) {
  return std::generic_category().message(error);
}

CarrierResult<void> refuse(const std::filesystem::path& path, const std::string& why) {
  return carrier_failure(core::ErrorCode::kTransportFailed, path.string() + ": " + why);
}

CarrierResult<void> ensure_private_directory(const std::filesystem::path& directory) {
  if (::mkdir(directory.c_str(), kOwnerOnlyDirectory) != 0 && errno != EEXIST) {
    return refuse(directory, "cannot create the directory: " + reason(errno));
  }
  struct stat status {};
  // lstat: a link that somebody else may turn elsewhere is not our directory.
  if (::lstat(directory.c_str(), &status) != 0) {
    return refuse(directory, reason(errno));
  }
  if (!S_ISDIR(status.st_mode)) {
    return refuse(directory, "is not a directory");
  }
  if (status.st_uid != ::geteuid()) {
    return refuse(directory, "belongs to another user");
  }
  if ((status.st_mode & kOthers) != 0) {
    return refuse(directory, "other users may enter it; a socket needs a directory of mode 0700");
  }
  return {};
}

bool is_peer_of_same_user(int descriptor) noexcept {
  ucred peer{};
  socklen_t size = sizeof(peer);
  return ::getsockopt(descriptor, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 &&
         peer.uid == ::geteuid();
}

}  // namespace

CarrierResult<std::unique_ptr<LocalServer>> LocalServer::listen(const std::filesystem::path& path) {
  std::unique_ptr<LocalServer> server(new LocalServer(path));
  const auto set_up = ensure_private_directory(std::filesystem::absolute(path).parent_path())
                          .and_then([&] { return server->lock(); })
                          .and_then([&] { return server->clear_path(); })
                          .and_then([&] { return server->bind(); });
  if (!set_up) {
    return tl::unexpected<CarrierError>(set_up.error());
  }
  return server;
}

// The lock outlives no process, so it tells a live server from a dead one's leavings without
// knocking at its door.
CarrierResult<void> LocalServer::lock() {
  const std::string name = path_.string() + ".lock";
  lock_descriptor_ =
      ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, kOwnerOnlyFile);
  if (lock_descriptor_ < 0) {
    return refuse(name, reason(errno));
  }
  if (::flock(lock_descriptor_, LOCK_EX | LOCK_NB) != 0) {
    return refuse(path_, "another process listens here");
  }
  // Whoever had it before removes the file: then this is the lock of nothing.
  struct stat ours {};
  struct stat there {};
  if (::fstat(lock_descriptor_, &ours) != 0 || ::lstat(name.c_str(), &there) != 0 ||
      ours.st_ino != there.st_ino || ours.st_dev != there.st_dev) {
    return refuse(path_, "another process listened here until now");
  }
  locked_ = true;
  return {};
}

CarrierResult<void> LocalServer::clear_path() {
  struct stat status {};
  if (::lstat(path_.c_str(), &status) != 0) {
    return errno == ENOENT ? CarrierResult<void>() : refuse(path_, reason(errno));
  }
  if (!S_ISSOCK(status.st_mode)) {
    return refuse(path_, "exists and is not a socket");
  }
  // A program that does not know our lock may still be listening.
  boost::system::error_code error;
  Protocol::socket probe(context_);
  probe.connect(Protocol::endpoint(path_.string()), error);
  if (!error) {
    return refuse(path_, "another process listens here");
  }
  return ::unlink(path_.c_str()) == 0 ? CarrierResult<void>() : refuse(path_, reason(errno));
}

CarrierResult<void> LocalServer::bind() {
  if (path_.native().size() >= sizeof(sockaddr_un::sun_path)) {
    return refuse(path_, "is too long for a socket");
  }
  boost::system::error_code error;
  acceptor_.open(Protocol(), error);
  if (!error) {
    // Between bind and chmod the directory keeps everybody else out.
    acceptor_.bind(Protocol::endpoint(path_.string()), error);
    bound_ = !error;
  }
  if (!error && ::chmod(path_.c_str(), kOwnerOnlyFile) != 0) {
    return refuse(path_, reason(errno));
  }
  if (!error) {
    acceptor_.listen(1, error);
  }
  if (!error) {
    // A peer that is gone again between poll and accept must not block us.
    acceptor_.non_blocking(true, error);
  }
  return error ? refuse(path_, error.message()) : CarrierResult<void>();
}

LocalServer::~LocalServer() {
  if (bound_) {
    ::unlink(path_.c_str());
  }
  if (lock_descriptor_ >= 0) {
    // While it is locked: who opens it from now on makes a new one, and who has it open finds that
    // out (lock()).
    if (locked_) {
      ::unlink((path_.string() + ".lock").c_str());
    }
    ::close(lock_descriptor_);
  }
}

CarrierResult<std::unique_ptr<LocalSocket>> LocalServer::accept(core::Nanoseconds timeout_ns) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::nanoseconds(timeout_ns);
  pollfd waiting{acceptor_.native_handle(), POLLIN, 0};
  for (;;) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    const int ready =
        ::poll(&waiting, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0)));
    if (ready > 0) {
      std::unique_ptr<LocalSocket> end(new LocalSocket);
      boost::system::error_code error;
      acceptor_.accept(end->socket_, error);
      if (error && error != boost::asio::error::would_block) {
        return carrier_failure(core::ErrorCode::kTransportFailed,
                               path_.string() + ": " + error.message());
      }
      if (!error && is_peer_of_same_user(end->descriptor())) {
        end->keep_from_children();
        return end;
      }
    } else if (ready < 0 && errno != EINTR) {
      return carrier_failure(core::ErrorCode::kTransportFailed,
                             path_.string() + ": " + reason(errno));
    }
    if (std::chrono::steady_clock::now() >= deadline) {
      return carrier_failure(core::ErrorCode::kPeerSilent,
                             path_.string() + ": nobody connected in time");
    }
  }
}

}  // namespace towbench::protocol
