#include "board/block_table.h"

#include <map>
#include <random>
#include <utility>

#include <gtest/gtest.h>

namespace towbench::board {
namespace {

TEST(BlockTable, ABlockOfAnotherSizeIsAnotherBlock) {
  BlockTable table;
  EXPECT_EQ(table.find(0x8000'0000, 16), nullptr);
  table.add({.address = 0x8000'0000, .size = 16, .instructions = 4}).runs = 7;
  EXPECT_EQ(table.find(0x8000'0000, 12), nullptr);
  ASSERT_NE(table.find(0x8000'0000, 16), nullptr);
  EXPECT_EQ(table.find(0x8000'0000, 16)->runs, 7U);
  table.clear();
  EXPECT_EQ(table.find(0x8000'0000, 16), nullptr);
}

// Blocks in every order, more than the first slots hold, neighbours that fall on the same one: each
// keeps its own count, as in a map.
TEST(BlockTable, CountsAsAMapDoes) {
  std::minstd_rand random(3);
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  BlockTable table;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> truth;
  for (int step = 0; step < 200'000; ++step) {
    const std::uint32_t address = 0x8000'0000U + 2U * below(9000);
    const std::uint32_t size = 4U << below(2);
    Block* block = table.find(address, size);
    if (block == nullptr) {
      block = &table.add({.address = address, .size = size});
    }
    ++block->runs;
    ++truth[{address, size}];
  }
  ASSERT_EQ(table.blocks().size(), truth.size() + 1);
  for (const auto& [key, runs] : truth) {
    const Block* block = table.find(key.first, key.second);
    ASSERT_NE(block, nullptr);
    EXPECT_EQ(block->runs, runs);
  }
}

}  // namespace
}  // namespace towbench::board
