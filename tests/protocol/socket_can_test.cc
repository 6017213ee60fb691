// The real thing, on the kernel's virtual CAN interface. Where there is none these are skipped, and
// tests/carriers runs them in a machine that has one.
#include "protocol/carriers/socket_can.h"

#include <chrono>
#include <cstdlib>
#include <thread>

#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include "protocol/carriers/connection.h"
#include "tests/protocol/recording_sink.h"

namespace towbench::protocol {
namespace {

using core::ErrorCode;

constexpr core::Nanoseconds kCanShort_ns = 50 * core::kNanosecondsPerMillisecond;

// Another node, with frames that we would never send.
class RawNode {
 public:
  RawNode() : descriptor_(::socket(PF_CAN, SOCK_RAW, CAN_RAW)) {
    const int on = 1;
    ::setsockopt(descriptor_, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof(on));
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(::if_nametoindex("vcan0"));
    ::bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof(address));
  }
  RawNode(const RawNode&) = delete;
  RawNode& operator=(const RawNode&) = delete;
  ~RawNode() { ::close(descriptor_); }

  void send(std::uint32_t id, std::uint8_t first = 0, std::uint8_t second = 0) const {
    ::can_frame frame{};
    frame.can_id = id;
    frame.can_dlc = 8;
    frame.data[0] = first;
    frame.data[1] = second;
    EXPECT_EQ(::write(descriptor_, &frame, CAN_MTU), ssize_t{CAN_MTU});
  }
  void send_fd(std::uint32_t id) const {
    ::canfd_frame frame{};
    frame.can_id = id;
    frame.len = 64;
    EXPECT_EQ(::write(descriptor_, &frame, CANFD_MTU), ssize_t{CANFD_MTU});
  }

 private:
  int descriptor_;
};

class SocketCanTest : public testing::Test {
 protected:
  void SetUp() override {
    if (::if_nametoindex("vcan0") == 0) {
      // In the test machine it must be there: a skip would prove nothing.
      ASSERT_EQ(std::getenv("TOWBENCH_TEST_MACHINE"), nullptr) << "no vcan0";  // NOLINT
      GTEST_SKIP() << "this kernel has no vcan0";
    }
    near_ = std::move(*SocketCan::open("vcan0", CanDirection::kToController));
    far_ = std::move(*SocketCan::open("vcan0", CanDirection::kToPlant));
  }
  std::vector<CanFrame> received(SocketCan& port) const {
    std::array<CanFrame, 64> frames;
    const auto size = port.receive(frames, kCanShort_ns);
    return size ? std::vector<CanFrame>(frames.begin(),
                                        frames.begin() + static_cast<std::ptrdiff_t>(*size))
                : std::vector<CanFrame>{};
  }
  std::unique_ptr<SocketCan> near_;
  std::unique_ptr<SocketCan> far_;
};

TEST(SocketCanOpening, NamesTheInterfaceThatItCannotOpen) {
  for (const std::string name : {"no-such-can", "lo", "", "a-name-that-is-too-long"}) {
    const auto port = SocketCan::open(name, CanDirection::kToPlant);
    ASSERT_FALSE(port.has_value()) << name;
    EXPECT_TRUE(port.error().message.starts_with(name + ": ")) << port.error().message;
  }
}

TEST_F(SocketCanTest, CarriesFramesInOrderBothWays) {
  std::vector<CanFrame> frames;
  for (std::uint32_t i = 0; i < 150; ++i) {
    frames.push_back(can_frame(can_id::kDuty + i % 2, i));
  }
  ASSERT_TRUE(near_->send(frames).has_value());
  std::vector<CanFrame> heard;
  for (auto some = received(*far_); !some.empty(); some = received(*far_)) {
    heard.insert(heard.end(), some.begin(), some.end());
  }
  EXPECT_EQ(heard, frames);
  const std::array answer{can_frame(can_id::kDigest, 5)};
  ASSERT_TRUE(far_->send(answer).has_value());
  EXPECT_EQ(received(*near_), std::vector<CanFrame>(answer.begin(), answer.end()));
}

TEST_F(SocketCanTest, HearsItsOwnDirectionOnlyAndIgnoresForeignFrames) {
  const RawNode other;
  other.send(can_id::kDuty);                   // goes the other way
  other.send(0x7fe);                           // somebody else's
  other.send(CAN_EFF_FLAG | can_id::kDigest);  // extended
  other.send(CAN_RTR_FLAG | can_id::kDigest);  // remote
  other.send(can_id::kDigest, 9);
  const auto heard = received(*near_);
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0].data[0], 9U);
}

TEST_F(SocketCanTest, CountsAndIgnoresFdFramesWhereTheInterfaceHasThem) {
  ASSERT_TRUE(near_->has_fd()) << "ip link set vcan0 mtu 72";
  const RawNode other;
  other.send_fd(can_id::kDigest);
  EXPECT_TRUE(received(*near_).empty());
  EXPECT_EQ(near_->counts().fd_frames, 1U);
}

TEST_F(SocketCanTest, CountsErrorFramesByKind) {
  const RawNode bus;
  bus.send(CAN_ERR_FLAG | CAN_ERR_CRTL, 0, CAN_ERR_CRTL_TX_PASSIVE);
  bus.send(CAN_ERR_FLAG | CAN_ERR_ACK);
  bus.send(CAN_ERR_FLAG | CAN_ERR_RESTARTED);
  bus.send(can_id::kDigest);
  EXPECT_EQ(received(*near_).size(), 1U);
  EXPECT_EQ(
      near_->counts(),
      (CanBusCounts{.error_frames = 3, .restarts = 1, .error_passive = 1, .no_acknowledge = 1}));
}

TEST_F(SocketCanTest, BusOffEndsTheSocketAfterWhatCameBeforeIt) {
  const RawNode bus;
  bus.send(can_id::kDigest, 1);
  bus.send(CAN_ERR_FLAG | CAN_ERR_BUSOFF);
  EXPECT_EQ(received(*near_).size(), 1U);
  std::array<CanFrame, 4> frames;
  EXPECT_EQ(near_->receive(frames, kCanShort_ns).error(), ErrorCode::kTransportFailed);
  EXPECT_EQ(near_->send(frames).error(), ErrorCode::kTransportFailed);
  // The interface has restarted; a new run opens it anew.
  bus.send(CAN_ERR_FLAG | CAN_ERR_RESTARTED);
  EXPECT_TRUE(SocketCan::open("vcan0", CanDirection::kToPlant).has_value());
}

TEST_F(SocketCanTest, AnInterfaceThatGoesDownIsAClosedPeer) {
  auto down = [](bool up) {
    const int s = ::socket(AF_INET, SOCK_DGRAM, 0);
    ifreq request{};
    std::string("vcan0").copy(request.ifr_name, 15);
    ::ioctl(s, SIOCGIFFLAGS, &request);
    request.ifr_flags = static_cast<short>(up ? request.ifr_flags | IFF_UP  // NOLINT
                                              : request.ifr_flags & ~IFF_UP);
    const int result = ::ioctl(s, SIOCSIFFLAGS, &request);
    ::close(s);
    return result == 0;
  };
  ASSERT_TRUE(down(false));
  std::array<CanFrame, 1> frames;
  EXPECT_EQ(near_->receive(frames, kCanShort_ns).error(), ErrorCode::kPeerClosed);
  EXPECT_EQ(near_->send(frames).error(), ErrorCode::kPeerClosed);
  const auto refused = SocketCan::open("vcan0", CanDirection::kToPlant);
  ASSERT_TRUE(down(true));
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("is down"), std::string::npos);
}

TEST_F(SocketCanTest, CountsWhatTheKernelDroppedWhileNobodyRead) {
  std::vector<CanFrame> frames(64, can_frame(can_id::kLines + 1U, 1));
  for (int i = 0; i < 1000; ++i) {  // more than any receive buffer holds
    ASSERT_TRUE(far_->send(frames).has_value());
  }
  std::uint64_t heard = 0;
  for (auto some = received(*near_); !some.empty(); some = received(*near_)) {
    heard += some.size();
  }
  EXPECT_LT(heard, 64'000U);
  // The kernel tells with the next frame that it takes.
  ASSERT_TRUE(far_->send(std::span(frames).first(1)).has_value());
  EXPECT_EQ(received(*near_).size(), 1U);
  EXPECT_EQ(near_->counts().dropped, 64'000U - heard);
}

TEST_F(SocketCanTest, TwoSidesFindEachOtherWhicheverIsFirst) {
  std::thread plant([] {
    auto connection =
        Connection::to_controller({.scheme = Scheme::kCan, .place = "vcan0"}, [] { return true; });
    ASSERT_TRUE(connection.has_value());
    const auto hello = (*connection)->await_hello([] { return true; });
    ASSERT_TRUE(hello.has_value());
    EXPECT_EQ(hello->axes_mask, 3U);
    (*connection)->link().peer().on(HelloReply{});
  });
  auto connection = Connection::to_plant({.scheme = Scheme::kCan, .place = "vcan0"});
  ASSERT_TRUE(connection.has_value()) << connection.error().message;
  (*connection)->link().peer().on(Hello{.axes_mask = 3});
  RecordingSink heard;
  EXPECT_TRUE((*connection)->link().wait_for(Turn::kHelloReply, heard).has_value());
  plant.join();
}

TEST_F(SocketCanTest, ABusWithoutAnEmulatorIsTold) {
  const auto connection = Connection::to_plant({.scheme = Scheme::kCan, .place = "vcan0"}, 1);
  ASSERT_FALSE(connection.has_value());
  EXPECT_EQ(connection.error().code, ErrorCode::kPeerSilent);
  EXPECT_EQ(connection.error().message, "can:vcan0: no emulator waits there");
}

}  // namespace
}  // namespace towbench::protocol
