#include "protocol/carriers/socket_can.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <vector>

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include "protocol/carriers/can_unpacker.h"

namespace towbench::protocol {
namespace {

using Clock = std::chrono::steady_clock;
using core::ErrorCode;

constexpr std::size_t kBatch = 64;

ErrorCode can_error(int error) noexcept {
  return error == ENETDOWN || error == ENODEV || error == ENXIO ? ErrorCode::kPeerClosed
                                                                : ErrorCode::kTransportFailed;
}

tl::unexpected<CarrierError> refuse(const std::string& interface, const std::string& why) {
  return carrier_failure(ErrorCode::kTransportFailed, interface + ": " + why);
}

// What the kernel filters for us: our identifiers, exactly, as classic data frames.
std::vector<can_filter> filters_for(CanDirection heard) {
  std::vector<can_filter> filters;
  for (std::uint32_t id = 0; id <= kMaxStandardId; ++id) {
    if (CanUnpacker::is_carried(heard, id)) {
      filters.push_back({id, CAN_SFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG});
    }
  }
  return filters;
}

// A classic frame is the beginning of one of FD (linux/can.h); how much of it is written says
// which.
static_assert(offsetof(::can_frame, data) == offsetof(canfd_frame, data));

canfd_frame to_kernel(const CanFrame& frame) noexcept {
  canfd_frame out{};
  out.can_id = frame.id;
  out.len = frame.size;
  out.flags = frame.is_fd ? CANFD_BRS : 0;
  std::copy_n(frame.data.begin(), frame.size, out.data);
  return out;
}

// Room for a batch of received frames and for the count of lost ones beside each.
struct Batch {
  alignas(cmsghdr) std::array<std::array<char, CMSG_SPACE(sizeof(std::uint32_t))>, kBatch> control;
  std::array<canfd_frame, kBatch> frames;
  std::array<iovec, kBatch> pieces;
  std::array<mmsghdr, kBatch> messages;

  explicit Batch(std::size_t size) noexcept {
    for (std::size_t i = 0; i < size; ++i) {
      pieces[i] = {&frames[i], sizeof(canfd_frame)};
      messages[i] = {};
      messages[i].msg_hdr.msg_iov = &pieces[i];
      messages[i].msg_hdr.msg_iovlen = 1;
      messages[i].msg_hdr.msg_control = control[i].data();
      messages[i].msg_hdr.msg_controllen = control[i].size();
    }
  }
  // The kernel's count of frames that this socket has lost so far, if it says so.
  void read_dropped(std::size_t i, std::uint32_t& dropped) noexcept {
    msghdr& header = messages[i].msg_hdr;
    for (cmsghdr* c = CMSG_FIRSTHDR(&header); c != nullptr; c = CMSG_NXTHDR(&header, c)) {
      if (c->cmsg_level == SOL_SOCKET && c->cmsg_type == SO_RXQ_OVFL) {
        std::memcpy(&dropped, CMSG_DATA(c), sizeof(dropped));
      }
    }
  }
};

}  // namespace

bool is_virtual_can(const std::string& interface) {
  std::error_code none;
  return !interface.empty() && interface.find('/') == std::string::npos &&
         std::filesystem::exists("/sys/devices/virtual/net/" + interface, none);
}

CarrierResult<std::unique_ptr<SocketCan>> SocketCan::open(const std::string& interface,
                                                          CanDirection heard, bool with_fd) {
  const int descriptor = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW);
  if (descriptor < 0) {
    return refuse(interface, errno == EAFNOSUPPORT || errno == EPROTONOSUPPORT
                                 ? "this kernel has no CAN (modules can and can_raw)"
                                 : std::strerror(errno));  // NOLINT(concurrency-mt-unsafe)
  }
  std::unique_ptr<SocketCan> port(new SocketCan(descriptor));
  if (!port->set_options(heard)) {
    return refuse(interface, "the kernel refuses the filters");
  }
  if (const auto bound = port->bind_to(interface); !bound) {
    return tl::unexpected<CarrierError>(bound.error());
  }
  if (with_fd && !port->has_fd_) {
    return refuse(interface, "has no CAN FD (ip link set " + interface + " mtu 72, or fd on)");
  }
  port->with_fd_ = with_fd;
  return port;
}

SocketCan::~SocketCan() {
  ::close(descriptor_);
}

bool SocketCan::set_options(CanDirection heard) noexcept {
  const auto filters = filters_for(heard);
  const can_err_mask_t errors = CAN_ERR_MASK;
  const int on = 1;
  // Two seconds of the busiest bus: a process that is not scheduled for a while loses nothing.
  const int receive_buffer = 4 << 20;
  (void)::setsockopt(descriptor_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof(receive_buffer));
  return ::setsockopt(descriptor_, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(),
                      static_cast<socklen_t>(filters.size() * sizeof(can_filter))) == 0 &&
         ::setsockopt(descriptor_, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &errors, sizeof(errors)) == 0 &&
         ::setsockopt(descriptor_, SOL_SOCKET, SO_RXQ_OVFL, &on, sizeof(on)) == 0;
}

CarrierResult<void> SocketCan::bind_to(const std::string& interface) {
  ifreq request{};
  if (interface.empty() || interface.size() >= sizeof(request.ifr_name)) {
    return refuse(interface, "is no name of an interface");
  }
  interface.copy(request.ifr_name, sizeof(request.ifr_name) - 1);
  if (::ioctl(descriptor_, SIOCGIFINDEX, &request) != 0) {
    return refuse(interface, "no such interface (ip link show type can; type vcan)");
  }
  const int index = request.ifr_ifindex;
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = index;
  if (::bind(descriptor_, reinterpret_cast<const sockaddr*>(&address),  // NOLINT
             sizeof(address)) != 0) {
    return refuse(interface, "is no CAN interface");
  }
  if (::ioctl(descriptor_, SIOCGIFFLAGS, &request) != 0 || (request.ifr_flags & IFF_UP) == 0) {
    return refuse(interface, "is down (ip link set " + interface + " up)");
  }
  const int on = 1;
  has_fd_ = ::ioctl(descriptor_, SIOCGIFMTU, &request) == 0 && request.ifr_mtu == CANFD_MTU &&
            ::setsockopt(descriptor_, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof(on)) == 0;
  return {};
}

core::Status SocketCan::send(std::span<const CanFrame> frames) noexcept {
  if (is_bus_off_) {
    return core::failure(ErrorCode::kTransportFailed);
  }
  const auto deadline = Clock::now() + std::chrono::nanoseconds(silence_limit_ns_);
  while (!frames.empty()) {
    std::array<canfd_frame, kBatch> out;
    std::array<iovec, kBatch> pieces;
    std::array<mmsghdr, kBatch> messages{};
    const std::size_t size = std::min(frames.size(), kBatch);
    for (std::size_t i = 0; i < size; ++i) {
      out[i] = to_kernel(frames[i]);
      pieces[i] = {&out[i], frames[i].is_fd ? std::size_t{CANFD_MTU} : std::size_t{CAN_MTU}};
      messages[i].msg_hdr.msg_iov = &pieces[i];
      messages[i].msg_hdr.msg_iovlen = 1;
    }
    const int sent = ::sendmmsg(descriptor_, messages.data(), static_cast<unsigned>(size), 0);
    if (sent > 0) {
      frames = frames.subspan(static_cast<std::size_t>(sent));
      continue;
    }
    if (errno == EINTR) {
      continue;
    }
    if (errno != ENOBUFS && errno != EAGAIN) {
      return core::failure(can_error(errno));
    }
    // The interface's queue is full. The socket stays writable meanwhile, so there is nothing to
    // wait on but time.
    ++counts_.queue_full;
    if (Clock::now() > deadline) {
      return core::failure(ErrorCode::kPeerSilent);
    }
    ::poll(nullptr, 0, 1);
  }
  return {};
}

bool SocketCan::set_receive_timeout(core::Nanoseconds timeout_ns) noexcept {
  // A zero timeval would mean for ever.
  const core::Nanoseconds timeout_us =
      std::max<core::Nanoseconds>(1, timeout_ns / core::kNanosecondsPerMicrosecond);
  constexpr core::Nanoseconds kMicrosecondsPerSecond = 1'000'000;
  timeval timeout{};
  timeout.tv_sec = static_cast<decltype(timeout.tv_sec)>(timeout_us / kMicrosecondsPerSecond);
  timeout.tv_usec = static_cast<decltype(timeout.tv_usec)>(timeout_us % kMicrosecondsPerSecond);
  if (::setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof(timeout)) != 0) {
    return false;
  }
  receive_timeout_ns_ = timeout_ns;
  return true;
}

core::Result<std::size_t> SocketCan::receive(std::span<CanFrame> into,
                                             core::Nanoseconds timeout_ns) noexcept {
  if (is_bus_off_) {
    return core::failure(ErrorCode::kTransportFailed);
  }
  const int flags = timeout_ns <= 0 ? MSG_DONTWAIT : MSG_WAITFORONE;
  if (timeout_ns > 0 && timeout_ns != receive_timeout_ns_ && !set_receive_timeout(timeout_ns)) {
    return core::failure(ErrorCode::kTransportFailed);
  }
  const std::size_t room = std::min(into.size(), kBatch);
  Batch batch(room);
  const int came =
      ::recvmmsg(descriptor_, batch.messages.data(), static_cast<unsigned>(room), flags, nullptr);
  if (came < 0) {
    const bool nothing = errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
    return nothing ? core::Result<std::size_t>(0U) : core::failure(can_error(errno));
  }
  std::uint32_t dropped = last_dropped_;
  std::size_t size = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(came); ++i) {
    batch.read_dropped(i, dropped);
    const canfd_frame& frame = batch.frames[i];
    if ((frame.can_id & CAN_ERR_FLAG) != 0) {
      note_error(frame.can_id & CAN_ERR_MASK, frame.data);
    } else if (batch.messages[i].msg_len != CAN_MTU && !with_fd_) {
      ++counts_.fd_frames;
    } else if ((frame.can_id & (CAN_EFF_FLAG | CAN_RTR_FLAG)) != 0) {
      ++counts_.foreign_frames;
    } else {
      CanFrame& ours = into[size++];
      ours.id = frame.can_id & CAN_SFF_MASK;
      ours.is_fd = batch.messages[i].msg_len != CAN_MTU;
      const std::size_t largest = ours.is_fd ? kCanFdDataSize : kCanDataSize;
      ours.size = static_cast<std::uint8_t>(std::min<std::size_t>(frame.len, largest));
      ours.data = {};
      std::copy_n(frame.data, ours.size, ours.data.begin());
    }
  }
  counts_.dropped += dropped - last_dropped_;
  last_dropped_ = dropped;
  return is_bus_off_ && size == 0 ? core::failure(ErrorCode::kTransportFailed)
                                  : core::Result<std::size_t>(size);
}

void SocketCan::note_error(std::uint32_t classes, const std::uint8_t* data) noexcept {
  ++counts_.error_frames;
  constexpr unsigned kWorseThanActive = CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING |
                                        CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE;
  counts_.restarts += (classes & CAN_ERR_RESTARTED) != 0 ? 1U : 0U;
  counts_.no_acknowledge += (classes & CAN_ERR_ACK) != 0 ? 1U : 0U;
  counts_.error_passive +=
      (classes & CAN_ERR_CRTL) != 0 && (data[1] & kWorseThanActive) != 0 ? 1U : 0U;
  if ((classes & CAN_ERR_BUSOFF) != 0) {
    ++counts_.bus_off;
    is_bus_off_ = true;
  }
}

}  // namespace towbench::protocol
