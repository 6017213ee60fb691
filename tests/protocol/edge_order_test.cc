#include "protocol/carriers/edge_order.h"

#include <vector>

#include <gtest/gtest.h>

#include "tests/protocol/edges_in_memory.h"

namespace towbench::protocol {
namespace {

NumberedEdge edge(std::uint32_t sequence, unsigned place, std::uint32_t line_sequence,
                  core::Nanoseconds time_ns = 0) {
  return {.sequence = sequence,
          .line_sequence = line_sequence,
          .edge = {.place = static_cast<std::uint8_t>(place), .time_ns = time_ns}};
}

std::vector<unsigned> places(const core::Result<std::span<const LineEdge>>& taken) {
  std::vector<unsigned> all;
  if (taken) {
    for (const LineEdge& each : *taken) {
      all.push_back(each.place);
    }
  }
  return all;
}

using Places = std::vector<unsigned>;

TEST(EdgeOrder, EdgesThatOvertookEachOtherComeInTheOrderInWhichTheyHappened) {
  EdgeOrder order;
  ASSERT_TRUE(order.add(edge(2, 1, 1)).has_value());
  ASSERT_TRUE(order.add(edge(1, 0, 1)).has_value());
  ASSERT_TRUE(order.add(edge(4, 1, 2)).has_value());
  EXPECT_EQ(places(order.take(0)), (Places{0, 1})) << "the third has not come yet";
  ASSERT_TRUE(order.add(edge(3, 2, 1)).has_value());
  EXPECT_EQ(places(order.take(0)), (Places{2, 1}));
}

TEST(EdgeOrder, AnEdgeThatTheQueueThrewAwayIsALossAtOnce) {
  EdgeOrder order;
  ASSERT_TRUE(order.add(edge(1, 0, 1)).has_value());
  const auto status = order.add(edge(3, 0, 3));
  ASSERT_FALSE(status.has_value());
  EXPECT_EQ(status.error(), core::ErrorCode::kSequence);
}

TEST(EdgeOrder, AHoleThatNobodyFillsIsALossAfterAWhile) {
  EdgeOrder order;
  constexpr core::Nanoseconds kThen_ns = 1'000'000;
  ASSERT_TRUE(order.add(edge(2, 0, 1, kThen_ns)).has_value());
  EXPECT_EQ(places(order.take(kThen_ns + EdgeOrder::kPatience_ns)), Places{});
  const auto late = order.take(kThen_ns + EdgeOrder::kPatience_ns + 1);
  ASSERT_FALSE(late.has_value());
  EXPECT_EQ(late.error(), core::ErrorCode::kSequence);
}

TEST(EdgeOrder, AnEdgeThatComesTwiceIsRefused) {
  EdgeOrder order;
  ASSERT_TRUE(order.add(edge(1, 0, 1)).has_value());
  (void)order.take(0);
  EXPECT_FALSE(order.add(edge(1, 0, 1)).has_value());
  EXPECT_FALSE(order.add(edge(1, 1, 1)).has_value()) << "a number that was taken already";
}

TEST(EdgeOrder, ALineThatIsNoneIsRefused) {
  EdgeOrder order;
  EXPECT_FALSE(order.add(edge(1, kEncoderChannelsAndIndex, 1)).has_value());
}

TEST(EdgeOrder, LosesNothingOfWhatIsReadInTime) {
  EdgesInMemory lines([] { return core::Nanoseconds{0}; });
  std::size_t come = 0;
  for (int round = 0; round < 100; ++round) {
    for (int i = 0; i < 500; ++i) {
      ASSERT_TRUE(lines.driver().set(0, i % 2 == 0).has_value());
    }
    const auto taken = lines.reader().read();
    ASSERT_TRUE(taken.has_value());
    come += taken->size();
  }
  EXPECT_EQ(come, 50'000U);
}

TEST(EdgesInMemory, AFullQueueIsALossAsInTheKernel) {
  EdgesInMemory lines([] { return core::Nanoseconds{0}; }, false, 64);
  for (int i = 0; i < 64; ++i) {
    (void)lines.driver().set(0, i % 2 == 0);
  }
  EXPECT_TRUE(lines.reader().read().has_value());
  for (int i = 0; i < 65; ++i) {
    (void)lines.driver().set(0, i % 2 == 0);
  }
  EXPECT_FALSE(lines.reader().read().has_value());
}

TEST(EncoderPlaces, AreThereAndBackAgain) {
  for (unsigned place = 0; place < kEncoderChannelsAndIndex; ++place) {
    EXPECT_EQ(place_of(axis_at(place), line_at(place)), place);
  }
  EXPECT_EQ(place_of(core::Axis::kX, EncoderLine::kB), 3U);
  EXPECT_EQ(place_of(core::Axis::kY, EncoderLine::kIndex), 4U);
}

}  // namespace
}  // namespace towbench::protocol
