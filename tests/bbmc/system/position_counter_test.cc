#include "bbmc/system/position_counter.h"

#include <gtest/gtest.h>

#include "core/random.h"

namespace towbench::bbmc {
namespace {

TEST(Defect11PositionWraps, AWalkAcrossTheRegistersEndsIsCountedAsIfThereWereNone) {
  for (const std::uint32_t max : {9'999U, 0xFFFF'FFFFU}) {
    PositionCounter counter(max);
    core::Random random(3);
    const std::int64_t range = static_cast<std::int64_t>(max) + 1;
    std::int64_t truth = range - 500;  // near the top
    static_cast<void>(counter.update(static_cast<std::uint32_t>(truth)));
    const std::int64_t start = counter.count();
    const std::int64_t first = truth;
    for (int i = 0; i < 10'000; ++i) {
      truth += static_cast<std::int64_t>((random.uniform() - 0.48) * 4'000);
      const std::int64_t wrapped = ((truth % range) + range) % range;
      static_cast<void>(counter.update(static_cast<std::uint32_t>(wrapped)));
      ASSERT_EQ(counter.count() - start, truth - first);
    }
    EXPECT_GT(truth - first, range / 100'000);
  }
}

TEST(PositionCounter, DeclaringAPositionMovesTheFrameNotTheRawCount) {
  PositionCounter counter;
  static_cast<void>(counter.update(100));
  counter.declare(-5'000);
  EXPECT_EQ(counter.count(), -5'000);
  EXPECT_EQ(counter.raw(), 100);
  static_cast<void>(counter.update(90));
  EXPECT_EQ(counter.count(), -5'010);
}

TEST(PositionCounter, AnOlderLatchIsUnwrappedBesideThePresentCount) {
  PositionCounter counter(9'999);
  static_cast<void>(counter.update(9'990));
  static_cast<void>(counter.update(10));  // wrapped upwards
  EXPECT_EQ(counter.unwrap(9'995), counter.raw() - 15);
}

}  // namespace
}  // namespace towbench::bbmc
