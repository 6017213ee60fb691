// Encoder edges over CAN FD frames.
#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

#include "core/random.h"
#include "protocol/carriers/can_link.h"
#include "protocol/carriers/can_packer.h"
#include "protocol/carriers/can_unpacker.h"
#include "tests/protocol/can_sinks.h"
#include "tests/protocol/recording_sink.h"

namespace towbench::protocol {
namespace {

EncoderEdges some_edges(core::Axis axis, std::size_t count, std::uint32_t sequence) {
  EncoderEdges edges;
  edges.axis = axis;
  edges.start_ns = 1'000'000 * core::Nanoseconds{sequence};
  edges.end_ns = edges.start_ns + 1'000'000;
  edges.sequence = sequence;
  for (std::size_t i = 0; i < count; ++i) {
    (void)edges.edges.push_back(EncoderEdge(static_cast<std::uint32_t>(500 + i % 400),
                                            i % 2 == 0 ? EncoderLine::kA : EncoderLine::kB));
  }
  return edges;
}

TEST(CanFd, AFrameHasOneOfTheSizesOfTheStandard) {
  for (std::size_t size = 0; size <= kCanDataSize; ++size) {
    EXPECT_EQ(can_fd_size(size), size);
  }
  EXPECT_EQ(can_fd_size(9), 12U);
  EXPECT_EQ(can_fd_size(25), 32U);
  EXPECT_EQ(can_fd_size(33), 48U);
  EXPECT_EQ(can_fd_size(49), 64U);
  EXPECT_EQ(can_fd_size(64), 64U);
}

TEST(CanFd, EveryNumberOfEdgesArrivesAsItWasSent) {
  CanUnpacker unpacker(CanDirection::kToController);
  RecordingSink heard;
  DirectBus bus(unpacker, heard);
  CanPacker packer(CanDirection::kToController, bus, true);
  RecordingSink sent;
  for (std::uint32_t count = 0; count <= kMaxEdgesPerMessage; ++count) {
    const auto edges = some_edges(core::kPlanarAxes[count % 2], count, count);
    packer.on(edges);
    sent.on(edges);
  }
  EXPECT_EQ(heard.texts, sent.texts);
  EXPECT_EQ(unpacker.counts().errors(), 0U);
  EXPECT_EQ(packer.refused(), 0U);
}

TEST(CanFd, AMessageIsSixtyThreeBytesAFrameAndTheLastIsNoLongerThanItMustBe) {
  KeepingFrames frames;
  CanPacker packer(CanDirection::kToController, frames, true);
  packer.on(some_edges(core::Axis::kX, 30, 7));  // 25 + 120 bytes, 6 around them
  ASSERT_EQ(frames.frames.size(), 3U);
  for (const auto& frame : frames.frames) {
    EXPECT_EQ(frame.id, can_id::kEdges + 1);
    EXPECT_TRUE(frame.is_fd);
  }
  EXPECT_EQ(frames.frames[0].size, 64U);
  EXPECT_EQ(frames.frames[0].data[0], 0x82);
  EXPECT_EQ(frames.frames[0].data[1], 145U) << "length, little-endian";
  EXPECT_EQ(frames.frames[2].size, 32U) << "151 - 126 bytes behind one";
  EXPECT_EQ(frames.frames[2].data[0], 0U);
}

TEST(CanFd, AMessageThatLostAFrameIsDroppedAndTheNextArrives) {
  for (int lost = 0; lost < 3; ++lost) {
    CanUnpacker unpacker(CanDirection::kToController);
    RecordingSink heard;
    KeepingFrames frames;
    CanPacker packer(CanDirection::kToController, frames, true);
    packer.on(some_edges(core::Axis::kY, 30, 1));
    packer.on(some_edges(core::Axis::kY, 30, 2));
    frames.frames.erase(frames.frames.begin() + lost);
    for (const auto& frame : frames.frames) {
      unpacker.take(frame, heard);
    }
    ASSERT_EQ(heard.texts.size(), 1U) << lost;
    EXPECT_GT(unpacker.counts().errors(), 0U);
  }
}

TEST(CanFd, NoFlippedBitIsDelivered) {
  KeepingFrames frames;
  CanPacker packer(CanDirection::kToController, frames, true);
  packer.on(some_edges(core::Axis::kY, 20, 1));
  for (std::size_t i = 0; i < frames.frames.size(); ++i) {
    for (std::size_t bit = 0; bit < 8U * frames.frames[i].size; ++bit) {
      auto damaged = frames.frames;
      damaged[i].data[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
      CanUnpacker unpacker(CanDirection::kToController);
      RecordingSink heard;
      for (const auto& frame : damaged) {
        unpacker.take(frame, heard);
      }
      const bool in_padding = i + 1 == frames.frames.size() && heard.texts.size() == 1;
      EXPECT_TRUE(heard.texts.empty() || in_padding) << i << ' ' << bit;
    }
  }
}

TEST(CanFd, AHundredThousandFramesOfAnyContentCrashNothing) {
  const auto unpacker = std::make_unique<CanUnpacker>(CanDirection::kToController);
  RecordingSink heard;
  core::Random random(3);
  for (int i = 0; i < 100'000; ++i) {
    CanFrame frame{.id = can_id::kEdges + static_cast<std::uint32_t>(random.bits() % 2),
                   .is_fd = random.bits() % 16 != 0};
    frame.size = static_cast<std::uint8_t>(random.bits() % 4 == 0 ? can_fd_size(random.bits() % 65)
                                                                  : kCanFdDataSize);
    for (auto& byte : frame.data) {
      byte = static_cast<std::uint8_t>(random.bits());
    }
    if (random.bits() % 2 == 0) {
      frame.data[0] = static_cast<std::uint8_t>(random.bits() % 2 == 0 ? 0x81 : 0);
    }
    unpacker->take(frame, heard);
  }
  EXPECT_TRUE(heard.texts.empty());
  EXPECT_GT(unpacker->counts().errors(), 10'000U);
}

// ---- both ends of a link ----

class FdPort final : public CanPort {
 public:
  explicit FdPort(bool has_fd) : has_fd_(has_fd) {}
  [[nodiscard]] bool carries_fd() const noexcept override { return has_fd_; }
  core::Status send(std::span<const CanFrame> frames) noexcept override {
    other->waiting.insert(other->waiting.end(), frames.begin(), frames.end());
    return {};
  }
  core::Result<std::size_t> receive(std::span<CanFrame> into,
                                    core::Nanoseconds /*timeout_ns*/) noexcept override {
    const std::size_t size = std::min(into.size(), waiting.size());
    const auto end = waiting.begin() + static_cast<std::ptrdiff_t>(size);
    std::copy(waiting.begin(), end, into.begin());
    waiting.erase(waiting.begin(), end);
    return size;
  }
  FdPort* other = nullptr;
  std::vector<CanFrame> waiting;

 private:
  bool has_fd_;
};

// What the plant hears of a controller that can do both, by who has FD.
std::uint32_t offered(bool controller_has_fd, bool plant_has_fd) {
  struct HelloWatch final : MessageSink {
    using MessageSink::on;
    void on(const Hello& hello) noexcept override { capabilities = hello.capabilities; }
    std::uint32_t capabilities = 0;
  } watch;
  FdPort near(controller_has_fd);
  FdPort far(plant_has_fd);
  near.other = &far;
  far.other = &near;
  CanLink controller(near, CanDirection::kToPlant);
  CanLink plant(far, CanDirection::kToController);
  controller.peer().on(Hello{.capabilities = kCapabilityEdges | kCapabilityDigest});
  EXPECT_TRUE(plant.wait(watch).has_value());
  return watch.capabilities;
}

TEST(CanFd, EdgesAreAgreedOnOnlyWhereBothEndsHaveIt) {
  EXPECT_EQ(offered(true, true), kCapabilityEdges | kCapabilityDigest);
  EXPECT_EQ(offered(true, false), kCapabilityDigest);
  EXPECT_EQ(offered(false, true), kCapabilityDigest);
  EXPECT_EQ(offered(false, false), kCapabilityDigest);
}

}  // namespace
}  // namespace towbench::protocol
