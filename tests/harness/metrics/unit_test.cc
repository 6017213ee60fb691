// Units of an axis: a metric's, and rad for m where the load turns.
#include <gtest/gtest.h>

#include "harness/metrics/run_data.h"

namespace towbench::harness {
namespace {

TEST(AxisUnit, IsRadForMetresOfAJointAlone) {
  AxisLimits line;
  AxisLimits joint;
  joint.turns = true;
  for (const char* unit : {"m", "m/s", "s", "1", "%"}) {
    EXPECT_EQ(line.unit(unit), unit);
  }
  EXPECT_EQ(joint.unit("m"), "rad");
  EXPECT_EQ(joint.unit("m/s"), "rad/s");
  for (const char* unit : {"s", "1", "%"}) {
    EXPECT_EQ(joint.unit(unit), unit);
  }
}

}  // namespace
}  // namespace towbench::harness
