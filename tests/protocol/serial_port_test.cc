#include "protocol/carriers/serial_port.h"

#include <cstdlib>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>
#include <poll.h>

#include "core/random.h"
#include "protocol/carriers/lockstep_link.h"
#include "protocol/cobs.h"
#include "tests/protocol/pty.h"
#include "tests/protocol/recording_sink.h"

namespace towbench::protocol {
namespace {

using core::ErrorCode;
using core::kNanosecondsPerMillisecond;

constexpr std::uint32_t kBaud = 921'600;
constexpr core::Nanoseconds kPortSoon_ns = 5 * core::kNanosecondsPerSecond;

std::unique_ptr<SerialPort> open(const std::filesystem::path& path, std::uint32_t baud = kBaud) {
  auto port = SerialPort::open(path, baud);
  EXPECT_TRUE(port.has_value()) << (port ? "" : port.error().message);
  return port ? std::move(*port) : nullptr;
}

std::string refusal(const std::filesystem::path& path, std::uint32_t baud = kBaud) {
  const auto port = SerialPort::open(path, baud);
  return port ? "" : port.error().message;
}

// The far end of a pty as a byte stream, for a peer in the same process.
class FarEnd final : public ByteStream {
 public:
  explicit FarEnd(const Pty& pty) : descriptor_(pty.far_end()) {}
  core::Status write(std::span<const std::byte> bytes) noexcept override {
    return ::write(descriptor_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size())
               ? core::Status()
               : core::failure(ErrorCode::kTransportFailed);
  }
  core::Result<std::size_t> read_some(std::span<std::byte> into,
                                      core::Nanoseconds timeout_ns) noexcept override {
    pollfd waiting{descriptor_, POLLIN, 0};
    if (::poll(&waiting, 1, static_cast<int>(timeout_ns / kNanosecondsPerMillisecond)) <= 0) {
      return 0U;
    }
    const ssize_t size = ::read(descriptor_, into.data(), into.size());
    return size > 0 ? core::Result<std::size_t>(static_cast<std::size_t>(size))
                    : core::failure(ErrorCode::kPeerClosed);
  }

 private:
  int descriptor_;
};

TEST(SerialPort, RunsInLockstepOverARealTerminal) {
  const Pty pty;
  const auto port = open(pty.path());
  std::thread plant_side([&] {
    FarEnd end(pty);
    SerialLockstepLink link(end);
    class Plant final : public MessageSink {
     public:
      using MessageSink::on;
      explicit Plant(MessageSink& controller) : controller_(controller) {}
      // Times whose bytes include every control character that a cooked terminal would eat.
      void on(const Advance& m) noexcept override { controller_.on(Advanced{m.until_ns}); }

     private:
      MessageSink& controller_;
    } plant(link.peer());
    while (true) {
      const auto turn = link.wait(plant);
      if (!turn || *turn == Turn::kBye) {
        return;
      }
    }
  });
  SerialLockstepLink link(*port);
  RecordingSink controller;
  for (core::Nanoseconds i = 0; i < 300; ++i) {
    const core::Nanoseconds time_ns = i * 0x01010101;
    link.peer().on(Advance{time_ns});
    ASSERT_TRUE(link.wait_for(Turn::kAdvanced, controller).has_value());
    ASSERT_EQ(controller.texts.back(), "Advanced " + std::to_string(time_ns));
  }
  link.peer().on(Bye{});
  plant_side.join();
  EXPECT_EQ(link.counts().errors(), 0U);
}

TEST(SerialPort, FindsItsPlaceAfterGarbageOnTheLine) {
  const Pty pty;
  const auto port = open(pty.path());
  FarEnd end(pty);
  core::Random random(1);
  std::vector<std::byte> garbage(777);
  for (auto& byte : garbage) {
    byte = static_cast<std::byte>(random.bits());
  }
  garbage.push_back(std::byte{0});
  ASSERT_TRUE(end.write(garbage).has_value());
  CobsWriter writer(end);
  writer.on(Advanced{42});
  SerialLockstepLink link(*port);
  RecordingSink controller;
  EXPECT_TRUE(link.wait_for(Turn::kAdvanced, controller).has_value());
  EXPECT_EQ(controller.texts, std::vector<std::string>{"Advanced 42"});
  EXPECT_GT(link.counts().errors(), 0U);
}

TEST(SerialPort, TakesAnyBaudRate) {
  const Pty pty;
  for (const std::uint32_t baud : {300U, 9600U, 115'200U, 250'000U, 1'234'567U, 3'000'000U}) {
    EXPECT_EQ(open(pty.path(), baud)->baud(), baud);
  }
  EXPECT_NE(refusal(pty.path(), 0), "");
}

TEST(SerialPort, IsHeldByOneAtATime) {
  const Pty pty;
  auto port = open(pty.path());
  EXPECT_NE(refusal(pty.path()).find(pty.path().string()), std::string::npos);
  port.reset();
  EXPECT_EQ(refusal(pty.path()), "");
}

TEST(SerialPort, RefusesWhatIsNoSerialPort) {
  EXPECT_NE(refusal("/dev/null").find("/dev/null"), std::string::npos);
  EXPECT_NE(refusal("/nonexistent/tty"), "");
}

TEST(SerialPort, NoticesThatItWasUnpluggedAndOpensAgainWhenItIsBack) {
  const auto link =
      std::filesystem::temp_directory_path() / ("towbench-test-tty-" + std::to_string(::getpid()));
  std::array<std::byte, 16> bytes{};
  {
    Pty pty;
    std::filesystem::create_symlink(pty.path(), link);
    const auto port = open(link);
    EXPECT_EQ(port->read_some(bytes, 0).value(), 0U);
    pty.unplug();
    EXPECT_EQ(port->read_some(bytes, kPortSoon_ns).error(), ErrorCode::kPeerClosed);
    EXPECT_EQ(port->write(bytes).error(), ErrorCode::kPeerClosed);
  }
  EXPECT_NE(refusal(link), "") << "still away";
  {
    const Pty pty;
    std::filesystem::remove(link);
    std::filesystem::create_symlink(pty.path(), link);
    const auto port = open(link);
    FarEnd end(pty);
    ASSERT_TRUE(end.write(bytes).has_value());
    EXPECT_EQ(port->read_some(bytes, kPortSoon_ns).value(), bytes.size());
  }
  std::filesystem::remove(link);
}

TEST(SerialPort, GivesUpOnALineThatTakesNothing) {
  const Pty pty;
  const auto port = open(pty.path());
  port->set_silence_limit(kNanosecondsPerMillisecond);
  const std::vector<std::byte> much(1'000'000);
  EXPECT_EQ(port->write(much).error(), ErrorCode::kPeerSilent);
}

}  // namespace
}  // namespace towbench::protocol
