#include "protocol/carriers/lockstep_link.h"

#include <chrono>
#include <functional>
#include <memory>
#include <thread>

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "protocol/carriers/local_socket.h"
#include "tests/protocol/recording_sink.h"

namespace towbench::protocol {
namespace {

using core::ErrorCode;
using Clock = std::chrono::steady_clock;

constexpr core::Nanoseconds kShort_ns = 20 * core::kNanosecondsPerMillisecond;

// Answers each Advance with edges and Advanced, as a plant does; answers Hello and Bye.
class SmallPlant final : public MessageSink {
 public:
  using MessageSink::on;
  explicit SmallPlant(MessageSink& controller) : controller_(controller) {}
  void on(const Hello& hello) noexcept override { controller_.on(HelloReply{.plant = hello}); }
  void on(const PwmDuty& duty) noexcept override { last_duty_ = duty; }
  void on(const Advance& advance) noexcept override {
    EncoderEdges edges;
    edges.end_ns = advance.until_ns;
    edges.sequence = last_duty_.channel_a_ticks;  // so that the answer depends on what was sent
    controller_.on(edges);
    controller_.on(Advanced{advance.until_ns});
  }
  void on(const Bye& bye) noexcept override { controller_.on(bye); }

 private:
  MessageSink& controller_;
  PwmDuty last_duty_;
};

void serve_until_bye(LocalSocket& end) {
  LockstepLink link(end);
  SmallPlant plant(link.peer());
  while (true) {
    const auto turn = link.wait(plant);
    if (!turn || *turn == Turn::kBye) {
      return;
    }
  }
}

class LockstepLinkTest : public testing::Test {
 protected:
  LockstepLinkTest() {
    auto pair = LocalSocket::pair();
    near_ = std::move(pair->first);
    far_ = std::move(pair->second);
  }

  // A process that runs `what` on the far end. Our copy of that end is closed.
  pid_t start(const std::function<void(LocalSocket&)>& what) {
    const pid_t child = ::fork();
    if (child == 0) {
      near_.reset();
      what(*far_);
      ::_exit(0);
    }
    far_.reset();
    return child;
  }

  std::unique_ptr<LocalSocket> near_;
  std::unique_ptr<LocalSocket> far_;
  RecordingSink controller_;
};

TEST_F(LockstepLinkTest, RunsInLockstepWithAnotherProcess) {
  const pid_t child = start(serve_until_bye);
  LockstepLink link(*near_);
  link.peer().on(Hello{.axes_mask = 3});
  ASSERT_TRUE(link.wait_for(Turn::kHelloReply, controller_).has_value());
  std::vector<std::string> expected{controller_.texts};
  for (std::uint16_t i = 1; i <= 1000; ++i) {
    link.peer().on(PwmDuty{.channel_a_ticks = i, .period_ticks = 2000});
    link.peer().on(Advance{i});
    ASSERT_TRUE(link.wait_for(Turn::kAdvanced, controller_).has_value());
    const std::string number = std::to_string(i);
    expected.push_back("EncoderEdges y 0 0 " + number + ' ' + number);
    expected.push_back("Advanced " + number);
  }
  link.peer().on(Bye{});
  EXPECT_TRUE(link.wait_for(Turn::kBye, controller_).has_value());
  expected.emplace_back("Bye 0");
  EXPECT_EQ(controller_.texts, expected);
  EXPECT_EQ(link.counts().errors(), 0U);
  ::waitpid(child, nullptr, 0);
}

TEST_F(LockstepLinkTest, NoticesAtOnceThatThePeersProcessWasKilled) {
  const pid_t child = start([](LocalSocket& end) {
    LockstepLink link(end);
    SmallPlant plant(link.peer());
    (void)link.wait(plant);
    ::kill(::getpid(), SIGKILL);  // between two exchanges
  });
  LockstepLink link(*near_);
  link.peer().on(Advance{1});
  ASSERT_TRUE(link.wait_for(Turn::kAdvanced, controller_).has_value());
  const auto start = Clock::now();
  link.peer().on(Advance{2});
  const auto status = link.wait_for(Turn::kAdvanced, controller_);
  ASSERT_FALSE(status.has_value());
  EXPECT_EQ(status.error(), ErrorCode::kPeerClosed);
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(1));
  ::waitpid(child, nullptr, 0);
}

TEST_F(LockstepLinkTest, NoticesThatThePeersProcessWasKilledWhileItWasWaiting) {
  const pid_t child = start([](LocalSocket& end) {
    std::array<std::byte, 100> bytes{};
    (void)end.read_some(bytes, 10 * core::kNanosecondsPerSecond);
    ::kill(::getpid(), SIGKILL);  // inside the exchange: asked, and never answers
  });
  LockstepLink link(*near_);
  link.peer().on(Advance{1});
  EXPECT_EQ(link.wait_for(Turn::kAdvanced, controller_).error(), ErrorCode::kPeerClosed);
  ::waitpid(child, nullptr, 0);
}

TEST_F(LockstepLinkTest, NoticesAPeerThatHangs) {
  LockstepLink link(*near_, kShort_ns);
  link.peer().on(Advance{1});
  const auto start = Clock::now();
  EXPECT_EQ(link.wait_for(Turn::kAdvanced, controller_).error(), ErrorCode::kPeerSilent);
  EXPECT_GE(Clock::now() - start, std::chrono::nanoseconds(kShort_ns));
  EXPECT_EQ(link.wait_for(Turn::kAdvanced, controller_).error(), ErrorCode::kPeerSilent)
      << "lost is lost";
}

TEST_F(LockstepLinkTest, TakesAPeerThatBabblesForSilent) {
  LockstepLink link(*near_, kShort_ns);
  std::atomic<bool> over = false;
  std::thread babbling([&] {
    far_->set_silence_limit(core::kNanosecondsPerMillisecond);
    LockstepLink other(*far_);
    for (std::uint32_t i = 0; !over; ++i) {
      other.peer().on(Heartbeat{0, i});  // valid frames, but never the answer
    }
  });
  EXPECT_EQ(link.wait_for(Turn::kAdvanced, controller_).error(), ErrorCode::kPeerSilent);
  over = true;
  babbling.join();
}

TEST_F(LockstepLinkTest, CountsGarbageAndStillFindsTheAnswer) {
  std::array<std::byte, 50> garbage{};
  garbage.fill(std::byte{0xee});
  ASSERT_TRUE(far_->write(garbage).has_value());
  LockstepLink other(*far_);
  other.peer().on(Advanced{7});
  LockstepLink link(*near_);
  EXPECT_TRUE(link.wait_for(Turn::kAdvanced, controller_).has_value());
  EXPECT_EQ(controller_.texts, std::vector<std::string>{"Advanced 7"});
  EXPECT_EQ(link.counts().errors(), 1U);
  EXPECT_EQ(link.counts().skipped_bytes, garbage.size());
}

TEST_F(LockstepLinkTest, HearsTheLastWordOfAPeerThatHasGone) {
  {
    LockstepLink other(*far_);
    other.peer().on(Advanced{7});
    other.peer().on(Bye{8});
  }
  far_.reset();
  LockstepLink link(*near_);
  link.peer().on(Advance{7});  // cannot be sent any more
  EXPECT_TRUE(link.wait_for(Turn::kAdvanced, controller_).has_value());
  EXPECT_TRUE(link.wait_for(Turn::kBye, controller_).has_value());
  EXPECT_EQ(link.wait_for(Turn::kAdvanced, controller_).error(), ErrorCode::kPeerClosed);
}

TEST_F(LockstepLinkTest, ReportsTurnsThatArriveTogetherOneByOneAndByeLast) {
  LockstepLink other(*far_);
  other.peer().on(Hello{});
  other.peer().on(Advance{1});
  other.peer().on(Bye{});
  LockstepLink link(*near_);
  EXPECT_EQ(link.wait(controller_).value(), Turn::kHello);
  EXPECT_EQ(link.wait(controller_).value(), Turn::kAdvance);
  EXPECT_EQ(link.wait(controller_).value(), Turn::kBye);
}

TEST_F(LockstepLinkTest, TakesByeForAnAnswerThatWillNotCome) {
  LockstepLink other(*far_);
  other.peer().on(Bye{});
  LockstepLink link(*near_);
  EXPECT_EQ(link.wait_for(Turn::kAdvanced, controller_).error(), ErrorCode::kPeerClosed);
}

}  // namespace
}  // namespace towbench::protocol
