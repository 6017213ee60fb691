#include "core/spsc_queue.h"

#include <cstdint>
#include <thread>

#include <gtest/gtest.h>

namespace towbench::core {
namespace {

TEST(SpscQueue, GivesBackInOrderAndRefusesWhenFull) {
  SpscQueue<int, 4> queue;
  int item = 0;
  EXPECT_FALSE(queue.pop(item));
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(queue.push(i));
  }
  EXPECT_FALSE(queue.push(4)) << "refused, not overwritten";
  EXPECT_EQ(queue.size(), 4U);
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(queue.pop(item));
    EXPECT_EQ(item, i);
  }
  EXPECT_TRUE(queue.empty());
}

TEST(SpscQueue, GoesRoundItsStorageManyTimes) {
  SpscQueue<int, 4> queue;
  int item = 0;
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE(queue.push(i));
    ASSERT_TRUE(queue.push(-i));
    ASSERT_TRUE(queue.pop(item));
    ASSERT_EQ(item, i);
    ASSERT_TRUE(queue.pop(item));
    ASSERT_EQ(item, -i);
  }
}

// Two halves that must match show a torn item; the sequence shows a lost or doubled one.
TEST(SpscQueue, PassesEveryItemOnceAndWholeBetweenTwoThreads) {
  struct Item {
    std::uint64_t number;
    std::uint64_t complement;
  };
  constexpr std::uint64_t kItems = 300'000;
  SpscQueue<Item, 64> queue;
  std::thread producer([&] {
    for (std::uint64_t i = 0; i < kItems;) {
      if (queue.push({i, ~i})) {
        ++i;
      } else {
        std::this_thread::yield();
      }
    }
  });
  std::uint64_t wrong = 0;
  for (std::uint64_t i = 0; i < kItems;) {
    Item item{};
    if (queue.pop(item)) {
      wrong += item.number != i || item.complement != ~i ? 1U : 0U;
      ++i;
    } else {
      std::this_thread::yield();
    }
  }
  producer.join();
  EXPECT_EQ(wrong, 0U);
  EXPECT_TRUE(queue.empty());
}

}  // namespace
}  // namespace towbench::core
