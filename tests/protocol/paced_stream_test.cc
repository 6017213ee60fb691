#include "protocol/carriers/paced_stream.h"

#include <deque>
#include <vector>

#include <gtest/gtest.h>

namespace towbench::protocol {
namespace {

class StreamClock final : public WireClock {
 public:
  core::Nanoseconds now_ns() noexcept override { return time_ns; }
  void wait_until(core::Nanoseconds until_ns) noexcept override {
    time_ns = std::max(time_ns, until_ns);
  }
  core::Nanoseconds time_ns = 0;
};

// Hands over bursts at the times they are due; waiting for one moves the clock.
class BurstyLine final : public ByteStream {
 public:
  explicit BurstyLine(StreamClock& clock) : clock_(clock) {}
  core::Status write(std::span<const std::byte> /*bytes*/) noexcept override { return {}; }
  core::Result<std::size_t> read_some(std::span<std::byte> into,
                                      core::Nanoseconds timeout_ns) noexcept override {
    const core::Nanoseconds deadline_ns = clock_.time_ns + timeout_ns;
    if (bursts.empty()) {
      return core::failure(core::ErrorCode::kPeerClosed);
    }
    if (bursts.front().time_ns > deadline_ns) {
      clock_.time_ns = deadline_ns;
      return 0U;
    }
    clock_.time_ns = std::max(clock_.time_ns, bursts.front().time_ns);
    const std::size_t size = std::min(into.size(), bursts.front().size);
    std::fill_n(into.begin(), size, std::byte{1});
    bursts.front().size -= size;
    if (bursts.front().size == 0) {
      bursts.pop_front();
    }
    return size;
  }
  struct Burst {
    core::Nanoseconds time_ns;
    std::size_t size;
  };
  std::deque<Burst> bursts;

 private:
  StreamClock& clock_;
};

TEST(WirePacer, KeepsTheRateExactOverAnyLength) {
  WirePacer pacer(921'600);
  core::Nanoseconds end_ns = 0;
  for (int i = 0; i < 921'600; ++i) {
    end_ns = pacer.reserve(0, 10);
  }
  EXPECT_EQ(end_ns, 10 * core::kNanosecondsPerSecond);
}

TEST(WirePacer, StartsAfreshAfterAnIdleTime) {
  WirePacer pacer(1'000'000);
  EXPECT_EQ(pacer.reserve(0, 10), 10'000);
  EXPECT_EQ(pacer.reserve(5'000, 10), 20'000) << "still busy";
  EXPECT_EQ(pacer.reserve(1'000'000, 10), 1'010'000);
}

TEST(PacedStream, SpreadsABurstOverItsWireTime) {
  StreamClock clock;
  BurstyLine line(clock);
  line.bursts = {{1'000, 3}, {2'000'000, 1}};
  PacedStream stream(line, clock, 1'000'000, 10);
  std::array<std::byte, 100> bytes{};
  std::vector<core::Nanoseconds> arrivals_ns;
  while (const auto size = stream.read_some(bytes, 10'000'000)) {
    for (std::size_t i = 0; i < *size; ++i) {
      arrivals_ns.push_back(clock.time_ns);
    }
  }
  EXPECT_EQ(arrivals_ns, (std::vector<core::Nanoseconds>{11'000, 21'000, 31'000, 2'010'000}));
}

TEST(PacedStream, DeliversNothingBeforeItsTimeAndKeepsToTheTimeout) {
  StreamClock clock;
  BurstyLine line(clock);
  line.bursts = {{0, 1}, {core::kNanosecondsPerSecond, 1}};
  PacedStream stream(line, clock, 1'000, 10);  // 10 ms a byte
  std::array<std::byte, 100> bytes{};
  EXPECT_EQ(stream.read_some(bytes, 0).value(), 0U);
  EXPECT_EQ(clock.time_ns, 0) << "a timeout of 0 never waits";
  EXPECT_EQ(stream.read_some(bytes, 4'000'000).value(), 0U);
  EXPECT_EQ(clock.time_ns, 4'000'000);
  EXPECT_EQ(stream.read_some(bytes, 20'000'000).value(), 1U);
  EXPECT_EQ(clock.time_ns, 10'000'000);
}

TEST(PacedStream, TheEndComesAfterTheBytesThatAreUnderWay) {
  StreamClock clock;
  BurstyLine line(clock);
  line.bursts = {{0, 20'000}};  // more than the stream holds at once
  PacedStream stream(line, clock, 1'000'000, 10);
  std::array<std::byte, 64> bytes{};
  std::size_t total = 0;
  auto size = stream.read_some(bytes, 1'000'000);
  for (; size; size = stream.read_some(bytes, 1'000'000)) {
    total += *size;
  }
  EXPECT_EQ(total, 20'000U);
  EXPECT_EQ(size.error(), core::ErrorCode::kPeerClosed);
  EXPECT_EQ(clock.time_ns, 200'000'000);
}

}  // namespace
}  // namespace towbench::protocol
