#include "harness/realtime/realtime_rights.h"

#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

using Processors = std::vector<int>;

TEST(RealtimeRights, LoopsTakeTheProcessorsThatTheKernelKeepsFree) {
  EXPECT_EQ(processors_for_loops({0, 1}, "2-3"), (Processors{0, 1, 2, 3}));
  EXPECT_EQ(processors_for_loops({0, 1, 2, 3}, "1,3"), (Processors{0, 2, 1, 3}));
  EXPECT_EQ(processors_for_loops({0, 1, 6, 7}, "2-3,5"), (Processors{0, 1, 6, 7, 2, 3, 5}));
}

TEST(RealtimeRights, WithoutSuchProcessorsTheLastAllowedOnesServe) {
  EXPECT_EQ(processors_for_loops({0, 1}, ""), (Processors{0, 1}));
  EXPECT_EQ(processors_for_loops({0, 1}, "(null)"), (Processors{0, 1}));
}

}  // namespace
}  // namespace towbench::harness
