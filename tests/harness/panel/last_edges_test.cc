#include "harness/panel/last_edges.h"

#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "bbmc/host/quadrature_decoder.h"

namespace towbench::harness {
namespace {

constexpr double kClock_Hz = 1.5625e6;
constexpr core::Nanoseconds kBehind_ns = 12'345;  // what was heard ends before the moment asked for

// An encoder's lines: toggled in either direction, with index edges in between.
class Encoder {
 public:
  void step(protocol::EncoderEdges& message, int direction, std::uint32_t after_ns) {
    const bool equal = (levels_ & 1U) == ((levels_ >> 1U) & 1U);
    const auto line =
        (direction > 0) == equal ? protocol::EncoderLine::kA : protocol::EncoderLine::kB;
    toggle(message, line, after_ns);
  }
  void toggle(protocol::EncoderEdges& message, protocol::EncoderLine line, std::uint32_t after_ns) {
    levels_ ^= 1U << static_cast<unsigned>(line);
    ASSERT_TRUE(message.edges.push_back(protocol::EncoderEdge(after_ns, line)));
  }
  [[nodiscard]] protocol::EncoderLevels levels() const {
    return static_cast<protocol::EncoderLevels>(levels_);
  }

 private:
  unsigned levels_ = 0;
};

// As they come to the page's side: through a row.
bbmc::Eqep::Reading registers(const bbmc::QuadratureDecoder& board) {
  const auto times = board.edge_times();
  const auto moment_ns = times.heard_until_ns + kBehind_ns;
  return registers_of(last_edges_of(times, moment_ns), moment_ns, kClock_Hz);
}

void expect_same(const bbmc::Eqep::Reading& ours, const bbmc::Eqep::Reading& boards, int message) {
  EXPECT_EQ(ours.time_ns, boards.time_ns) << message;
  EXPECT_EQ(ours.capture_ticks, boards.capture_ticks) << message;
  EXPECT_EQ(ours.since_edge_ticks, boards.since_edge_ticks) << message;
  EXPECT_EQ(ours.capture_valid, boards.capture_valid) << message;
  EXPECT_EQ(ours.forward, boards.forward) << message;
}

TEST(LastEdges, MakeTheBoardsOwnRegisters) {
  std::mt19937 draw(7);
  const auto below = [&](unsigned most) { return static_cast<unsigned>(draw() % most); };
  bbmc::QuadratureDecoder boards;
  ASSERT_TRUE(boards.configure({.capture_clock_Hz = kClock_Hz}));
  Encoder encoder;
  int direction = 1;
  auto message = std::make_unique<protocol::EncoderEdges>();
  for (int i = 0; i < 20'000; ++i) {
    message->start_ns = message->end_ns;
    message->sequence = static_cast<std::uint32_t>(i);
    message->start_levels = encoder.levels();
    message->edges.clear();
    core::Nanoseconds at_ns = message->start_ns;
    for (unsigned edges = below(4) == 0 ? below(40) : below(3); edges > 0; --edges) {
      direction = below(11) == 0 ? -direction : direction;
      const auto after_ns = 20 + below(3000);
      at_ns += after_ns;
      if (below(9) == 0) {
        encoder.toggle(*message, protocol::EncoderLine::kIndex, after_ns);
      } else {
        encoder.step(*message, direction, after_ns);
      }
    }
    message->end_ns = at_ns + below(200'000);
    ASSERT_TRUE(boards.take(*message));
    expect_same(registers(boards), boards.read(), i);
  }
}

TEST(LastEdges, MakeTheBoardsOwnRegistersOfADigest) {
  std::mt19937 draw(8);
  bbmc::QuadratureDecoder boards;
  protocol::EncoderReport report;
  for (int i = 0; i < 2000; ++i) {
    report.time_ns += core::kNanosecondsPerMillisecond;
    report.sequence = static_cast<std::uint32_t>(i);
    report.count_change = static_cast<std::int32_t>(draw() % 7) - 3;
    if (report.count_change != 0) {
      report.last_edge_ns = report.time_ns - static_cast<core::Nanoseconds>(draw() % 900'000U);
      report.capture_period_ns = 1000 + static_cast<std::uint32_t>(draw() % 500'000U);
    }
    ASSERT_TRUE(boards.take(report));
    expect_same(registers(boards), boards.read(), i);
  }
}

}  // namespace
}  // namespace towbench::harness
