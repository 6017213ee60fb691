// Rows that keep further axes only where a machine has them.
#include "harness/lockstep/kept_axes.h"

#include <utility>

#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

using core::Axis;

core::PerAxis<int> numbered() {
  return {{1, 2, 3, 4, 5, 6}};
}

TEST(KeptAxes, KeepTheTwoOfAPlaneAlone) {
  const KeptAxes<int> axes(numbered(), false);
  EXPECT_EQ(axes[Axis::kY], 1);
  EXPECT_EQ(axes[Axis::kX], 2);
  for (const auto further : core::kFurtherAxes) {
    EXPECT_EQ(axes[further], 0);
  }
}

TEST(KeptAxes, KeepAllWhereThereAreMore) {
  const KeptAxes<int> axes(numbered(), true);
  for (const auto which : core::kAllAxes) {
    EXPECT_EQ(axes[which], numbered()[which]);
  }
}

TEST(KeptAxes, ACopyIsItsOwn) {
  const KeptAxes<int> kept(numbered(), true);
  KeptAxes<int> copy(kept);
  copy[Axis::kC] = 60;
  EXPECT_EQ(kept[Axis::kC], 6);
  KeptAxes<int> assigned(numbered(), false);
  assigned = kept;
  EXPECT_EQ(assigned[Axis::kZ], 3);
  assigned = KeptAxes<int>(numbered(), false);
  EXPECT_EQ(std::as_const(assigned)[Axis::kZ], 0);
}

TEST(KeptAxes, AFurtherOneIsMadeWhenItIsWritten) {
  KeptAxes<int> axes;
  axes[Axis::kB] = 7;
  EXPECT_EQ(axes[Axis::kB], 7);
  EXPECT_EQ(axes[Axis::kA], 0);
}

}  // namespace
}  // namespace towbench::harness
