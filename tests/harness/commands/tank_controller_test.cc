// What a run of BBMC says on a machine that is not the tank.
#include "harness/commands/tank_controller.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string note_on(const char* rig) {
  SourceFiles sources;
  return tank_controller_note(load_rig(rig, sources));
}

TEST(TankController, IsSilentOnTheTank) {
  EXPECT_EQ(note_on("fixtures/rigs/macs-nominal.toml"), "");
}

TEST(TankController, NamesAnotherTransmission) {
  EXPECT_THAT(note_on("fixtures/machines/ball-screw/rig.toml"),
              AllOf(HasSubstr("y: screw"), Not(HasSubstr("rad"))));
}

TEST(TankController, SaysRadiansOfAJoint) {
  EXPECT_THAT(note_on("fixtures/machines/joint/rig.toml"),
              AllOf(HasSubstr("y: gear"), HasSubstr("read rad where it says m")));
}

}  // namespace
}  // namespace towbench::harness
