#include "core/bounded_vector.h"

#include <vector>

#include <gtest/gtest.h>

namespace towbench::core {
namespace {

std::vector<int> contents(const BoundedVector<int, 4>& v) {
  return {v.begin(), v.end()};
}

TEST(BoundedVector, KeepsOrderAndRefusesWhenFull) {
  BoundedVector<int, 4> v;
  EXPECT_TRUE(v.empty());
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(v.push_back(i));
  }
  EXPECT_TRUE(v.full());
  EXPECT_FALSE(v.push_back(99));
  EXPECT_EQ(contents(v), (std::vector{0, 1, 2, 3}));
}

TEST(BoundedVector, AssignsAllOrNothing) {
  BoundedVector<int, 4> v;
  EXPECT_TRUE(v.assign(std::vector{7, 8}));
  EXPECT_FALSE(v.assign(std::vector{1, 2, 3, 4, 5}));
  EXPECT_EQ(contents(v), (std::vector{7, 8}));
  EXPECT_TRUE(v.assign({}));
  EXPECT_TRUE(v.empty());
}

TEST(BoundedVector, CopiesWhatItHolds) {
  BoundedVector<int, 4> a;
  a.assign(std::vector{1, 2, 3});
  BoundedVector<int, 4> b(a);
  EXPECT_EQ(contents(b), contents(a));
  b[1] = 20;
  EXPECT_EQ(contents(a), (std::vector{1, 2, 3}));
  a = b;
  EXPECT_EQ(contents(a), (std::vector{1, 20, 3}));
  const auto& itself = a;
  a = itself;
  EXPECT_EQ(contents(a), (std::vector{1, 20, 3}));
}

TEST(BoundedVector, CanBeFilledAgainAfterClear) {
  BoundedVector<int, 4> v;
  v.assign(std::vector{1, 2, 3, 4});
  v.clear();
  EXPECT_TRUE(v.push_back(5));
  EXPECT_EQ(contents(v), std::vector{5});
}

TEST(BoundedVectorDeathTest, AnIndexBeyondTheSizeIsABug) {
  BoundedVector<int, 4> v;
  v.assign(std::vector{1});
  EXPECT_DEATH((void)v[1], "");
}

}  // namespace
}  // namespace towbench::core
