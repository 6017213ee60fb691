// The C client on CAN: its frames are those of the bench's packer, and it takes what the bench's
// unpacker does.
#include <array>
#include <memory>
#include <sstream>

#include <gtest/gtest.h>

#include "clients/c/towbench.h"
#include "core/random.h"
#include "protocol/carriers/can_link.h"
#include "protocol/codec.h"
#include "protocol/frame.h"
#include "tests/protocol/any_message.h"
#include "tests/protocol/can_sinks.h"
#include "tests/protocol/counter_model.h"
#include "tests/protocol/golden.h"
#include "tests/protocol/recording_sink.h"

namespace towbench::protocol {
namespace {

std::unique_ptr<tb_bench> new_client(tb_framing framing) {
  auto bench = std::make_unique<tb_bench>();
  tb_init(bench.get(), framing, 3, 1'000'000, TB_DIGEST | TB_EDGES | TB_REFERENCE);
  return bench;
}

// What a controller knows of the bench.
std::string known_by(const tb_bench& bench) {
  std::ostringstream out;
  for (const auto& axis : bench.axis) {
    out << axis.count << ' ' << axis.index_count << ' ' << axis.index_pulses << ' '
        << axis.illegal_transitions << ' ' << axis.reference.position_m << ' '
        << axis.reference.velocity_m_per_s << ' ' << axis.reference.acceleration_m_per_s2 << ' '
        << axis.current_A << ' ' << int{axis.levels} << ' ' << axis.absolute << ' '
        << axis.absolute_at_start << ' ' << axis.absolute_ns << '\n';
  }
  out << bench.now_ns << ' ' << bench.lines << ' ' << bench.refusal << ' ' << bench.capabilities
      << ' ' << bench.fault << ' ' << bench.faults << ' ' << bench.heartbeats << ' '
      << int{bench.reset};
  return out.str();
}

std::uint32_t errors_of(const tb_counts& counts) {
  return counts.bad_checksum + counts.too_long + counts.truncated + counts.unknown +
         counts.bad_field + counts.discarded_bytes;
}

// A client that takes whole payloads: the codec's test holds it to the bench's.
class WholeToClient final : public EachMessage<WholeToClient> {
 public:
  template <typename Message>
  void handle(const Message& message) noexcept {
    std::array<std::byte, kMaxPayloadSize> payload;
    const auto size = encode(message, payload);
    tb_take(bench.get(), reinterpret_cast<const std::uint8_t*>(payload.data()), size);  // NOLINT
  }
  std::unique_ptr<tb_bench> bench = new_client(TB_STREAM);
};

class FramesToClient final : public CanFrameSink {
 public:
  void on(const CanFrame& frame) noexcept override {
    ++frames;
    tb_feed_frame(bench.get(), frame.id, frame.data.data(), frame.size);
  }
  std::unique_ptr<tb_bench> bench = new_client(TB_CAN);
  int frames = 0;
};

// To a packer and to the client that takes whole payloads.
class BothWays final : public EachMessage<BothWays> {
 public:
  template <typename Message>
  void handle(const Message& message) noexcept {
    whole.on(message);
    packer.on(message);
  }
  WholeToClient whole;
  FramesToClient packed;
  CanPacker packer{CanDirection::kToController, packed};
};

TEST(CClientOnCan, TakesEveryMessageWithoutLosingABit) {
  BothWays ways;
  const auto expect_same = [&] {
    ASSERT_EQ(known_by(*ways.packed.bench), known_by(*ways.whole.bench));
    ASSERT_EQ(ways.packed.bench->counts.sequence_gaps, ways.whole.bench->counts.sequence_gaps);
  };
  for (const auto& golden : golden_messages()) {
    if (golden.name.find("Edges") == std::string::npos) {
      golden.send(ways);
    }
    expect_same();
  }
  AnyMessage any(5);
  core::Random random(3);
  constexpr unsigned kEdges = 3;
  for (int i = 0; i < 3000; ++i) {
    const auto kind = static_cast<unsigned>(random.bits() % AnyMessage::kKinds);
    if (kind != kEdges) {
      any.send_to(ways, kind);
    }
    expect_same();
  }
  EXPECT_EQ(errors_of(ways.packed.bench->counts), 0U);
}

TEST(CClientOnCan, TakesPackedReportsAtEverySpeed) {
  for (const double mean_edges : {0.0, 0.3, 1.0, 5.0, 142.0}) {
    BothWays ways;
    CounterModel model(9);
    constexpr int kReports = 20'000;
    for (int i = 0; i < kReports; ++i) {
      ways.on(model.next(mean_edges));
      ASSERT_EQ(known_by(*ways.packed.bench), known_by(*ways.whole.bench)) << mean_edges;
    }
    EXPECT_EQ(ways.packed.bench->counts.sequence_gaps, 0U);
    EXPECT_LT(ways.packed.frames, 2 * kReports) << "most reports come packed";
  }
}

TEST(CClientOnCan, TakesOfDamagedAndLostFramesWhatTheUnpackerDoes) {
  KeepingFrames pool;
  CanPacker packer(CanDirection::kToController, pool);
  AnyMessage any(2);
  CounterModel model(4);
  for (int i = 0; i < 3000; ++i) {
    packer.on(model.next(10.0));
    if (i % 10 == 0) {
      any.send_to(packer);
    }
  }
  core::Random random(77);
  CanUnpacker unpacker(CanDirection::kToController);
  WholeToClient reference;
  FramesToClient frames;
  for (CanFrame frame : pool.frames) {
    const auto luck = random.bits() % 100;
    if (luck == 0) {
      continue;
    }
    if (luck < 3) {
      frame.data[random.bits() % kCanDataSize] ^= static_cast<std::uint8_t>(random.bits());
    }
    frame.size = luck == 4 ? static_cast<std::uint8_t>(random.bits() % 9) : frame.size;
    unpacker.take(frame, reference);
    frames.on(frame);
    ASSERT_EQ(known_by(*frames.bench), known_by(*reference.bench));
  }
  EXPECT_GT(unpacker.counts().errors(), 50U);
  EXPECT_GT(errors_of(frames.bench->counts), 50U);
  EXPECT_GT(frames.bench->counts.sequence_gaps, 10U) << "a lost report is told at once";
}

std::vector<CanFrame> frames_in(tb_bench& bench) {
  std::vector<CanFrame> frames;
  for (std::size_t at = 0; at < bench.out_size; at += TB_FRAME_SIZE) {
    CanFrame frame{.id = bench.out[at] | std::uint32_t{bench.out[at + 1]} << 8U,
                   .size = kCanDataSize};
    std::copy_n(bench.out + at + 2, kCanDataSize, frame.data.begin());
    frames.push_back(frame);
  }
  bench.out_size = 0;
  return frames;
}

// What the client sends on a stream, as the bench's packer puts it.
class Expected {
 public:
  std::vector<CanFrame> frames_of(tb_bench& stream) {
    kept_.frames.clear();
    reader_.feed(std::as_bytes(std::span(stream.out, stream.out_size)), packer_);
    stream.out_size = 0;
    return kept_.frames;
  }

 private:
  KeepingFrames kept_;
  CanPacker packer_{CanDirection::kToPlant, kept_};
  FrameReader reader_;
};

TEST(CClientOnCan, SendsTheFramesOfTheBenchsPacker) {
  const auto can = new_client(TB_CAN);
  const auto stream = new_client(TB_STREAM);
  stream->wanted = can->wanted;  // no edges
  Expected expected;
  const auto expect_same = [&] {
    ASSERT_EQ(frames_in(*can), expected.frames_of(*stream)) << can->now_ns;
  };
  const auto both = [&](auto act) {
    act(can.get());
    act(stream.get());
  };
  both(tb_greet);
  expect_same();
  constexpr std::uint32_t kTurns = 33'000;  // the low bits of every sequence number wrap
  for (std::uint32_t i = 0; i < kTurns; ++i) {
    both([&](tb_bench* bench) {
      bench->now_ns = 1'000'000 * std::int64_t{i};
      tb_enable(bench, i % 4);
      tb_drive(bench, TB_Y, 1e-3 * (i % 2000) - 1.0, i % 3 != 0);
      tb_drive(bench, TB_X, 1.0 - 1e-3 * (i % 2000), 1);
      tb_end_turn(bench);
    });
    expect_same();
  }
  both([](tb_bench* bench) {
    bench->now_ns = std::int64_t{1} << 50U;  // a time that the packed frame has no room for
    tb_enable(bench, 3);
    tb_say_bye(bench);
  });
  expect_same();
}

TEST(CClientOnCan, WritesTheExactBits) {
  const auto bench = new_client(TB_CAN);
  bench->axis[TB_X].duty_sequence = 5;
  tb_drive(bench.get(), TB_X, 0.5, 1);
  // 2500 of 5000 ticks; enable is bit 48, the sequence stands above it: 5 << 1 | 1 = 0x000b.
  EXPECT_EQ(frames_in(*bench),
            (std::vector{CanFrame{0x101, 8, {0xc4, 0x09, 0x00, 0x00, 0x88, 0x13, 0x0b, 0x00}}}));
}

TEST(CClientOnCan, WritesNothingOfWhatDoesNotFit) {
  const auto bench = new_client(TB_CAN);
  while (tb_greet(bench.get()) != 0) {
  }
  const std::size_t greetings = TB_OUT_SIZE / TB_FRAME_SIZE / 5;
  EXPECT_EQ(frames_in(*bench).size(), greetings * 5) << "five frames each";
}

// A bus with the client at its other end.
class ClientPort final : public CanPort {
 public:
  explicit ClientPort(tb_bench& bench) : bench_(bench) {}
  core::Status send(std::span<const CanFrame> frames) noexcept override {
    for (const auto& frame : frames) {
      tb_feed_frame(&bench_, frame.id, frame.data.data(), frame.size);
    }
    return {};
  }
  core::Result<std::size_t> receive(std::span<CanFrame> into,
                                    core::Nanoseconds /*timeout_ns*/) noexcept override {
    const auto frames = frames_in(bench_);
    std::copy(frames.begin(), frames.end(), into.begin());
    return frames.size();
  }

 private:
  tb_bench& bench_;
};

TEST(CClientOnCan, GreetsAndTakesItsTurn) {
  const auto bench = new_client(TB_CAN);
  ClientPort port(*bench);
  CanLink plant(port, CanDirection::kToController, 5 * core::kNanosecondsPerMillisecond);
  RecordingSink heard;
  plant.peer().on(Heartbeat{});
  EXPECT_EQ(bench->heartbeats, 1U);
  tb_greet(bench.get());
  ASSERT_EQ(plant.wait(heard), Turn::kHello);
  EXPECT_EQ(heard.texts.back(), text_of(Hello{.role = Role::kController,
                                              .axes_mask = 3,
                                              .tick_ns = TB_TICK_NS,
                                              .exchange_ns = 1'000'000,
                                              .capabilities = TB_DIGEST | TB_REFERENCE}));
  EXPECT_EQ(tb_greeted(bench.get()), 0);
  plant.peer().on(HelloReply{.plant = {.role = Role::kPlant, .capabilities = TB_DIGEST}});
  EXPECT_EQ(tb_greeted(bench.get()), 1);
  EXPECT_EQ(bench->capabilities, std::uint32_t{TB_DIGEST});
  tb_end_turn(bench.get());
  ASSERT_EQ(plant.wait(heard), Turn::kAdvance);
  EXPECT_EQ(heard.texts.back(), text_of(Advance{0}));
  plant.peer().on(DigitalInputs{.lines = TB_KILL_SWITCH});
  EXPECT_EQ(tb_turn_over(bench.get()), 0);
  plant.peer().on(Advanced{0});
  EXPECT_EQ(tb_turn_over(bench.get()), 1);
  EXPECT_EQ(bench->lines, TB_KILL_SWITCH);
  plant.peer().on(Bye{0});
  EXPECT_EQ(tb_ended(bench.get()), 1);
}

// Eight lines fit into a frame of lines; with one behind them all go whole.
TEST(CClientOnCan, ReleasesTheBrakeOfEveryAxis) {
  const auto bench = new_client(TB_CAN);
  ClientPort port(*bench);
  CanLink plant(port, CanDirection::kToController, 5 * core::kNanosecondsPerMillisecond);
  RecordingSink heard;
  for (const core::Axis axis : core::kAllAxes) {
    const auto index = static_cast<unsigned>(core::index_of(axis));
    tb_enable_released(bench.get(), 3, static_cast<std::uint8_t>(1U << index));
    tb_end_turn(bench.get());
    ASSERT_EQ(plant.wait(heard), Turn::kAdvance);
    ASSERT_GE(heard.texts.size(), 2U);
    EXPECT_EQ(
        heard.texts.at(heard.texts.size() - 2),
        text_of(DigitalOutputs{.lines = static_cast<std::uint16_t>(3U | mask_of(brake_line(axis))),
                               .sequence = index}));
  }
}

}  // namespace
}  // namespace towbench::protocol
