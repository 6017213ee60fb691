// Units are part of a key: a way of an axis that moves in a line, an angle of one that turns.
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/experiment/experiment_fixture.h"
#include "harness/experiment/experiment_toml.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/record/temporary_folder.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

struct Motion {
  const char* rig;
  const char* start;
  const char* unit;  // of the reference's keys
};

class UnitsOfAMotion : public ::testing::Test {
 protected:
  UnitsOfAMotion() {
    for (const char* part : {"rigs", "plants", "machines"}) {
      std::filesystem::copy(fixtures_directory() / part, folder_.path() / part,
                            std::filesystem::copy_options::recursive);
    }
  }
  ExperimentFixture load(const Motion& motion) {
    const std::string unit = motion.unit;
    std::ofstream(folder_.path() / "motion.toml")
        << "schema = 1\nname = \"motion\"\nduration_limit_s = 5.0\nrig = \"" << motion.rig
        << "\"\n[start]\n"
        << motion.start << " = 0.6\n[[reference]]\nmove = \"trapezoid\"\naxis = \"y\"\nat_s = 0.5\n"
        << "distance_" << unit << " = 0.1\nspeed_" << unit << "_per_s = 0.2\nacceleration_" << unit
        << "_per_s2 = 1.0\n[[budget]]\nmetric = \"y_carriage_travel_m\"\nmin = 0.09\n";
    return load_experiment(folder_.path() / "motion.toml");
  }
  std::string refusal(const Motion& motion) {
    try {
      (void)load(motion);
    } catch (const FixtureError& error) {
      return error.what();
    }
    return "taken";
  }

 private:
  TemporaryFolder folder_;
};

constexpr const char* kJoint = "machines/joint/rig.toml";
constexpr const char* kTank = "rigs/macs-nominal.toml";

TEST_F(UnitsOfAMotion, AreRadiansWhereTheLoadTurns) {
  const auto fixture = load({kJoint, "y_rad", "rad"});
  EXPECT_EQ(fixture.rig.parameters.axes[core::Axis::kY].start_m, 0.6);
  EXPECT_EQ(fixture.experiment.reference.front().distance_m, 0.1);
  EXPECT_EQ(fixture.experiment.reference.front().acceleration_m_per_s2, 1.0);
}

TEST_F(UnitsOfAMotion, AreWrittenBackAsTheyWere) {
  const auto joint = to_toml(load({kJoint, "y_rad", "rad"}));
  EXPECT_THAT(joint, HasSubstr("distance_rad = 0.1\n"));
  EXPECT_THAT(joint, HasSubstr("speed_rad_per_s = 0.2\n"));
  const auto tank = to_toml(load({kTank, "y_m", "m"}));
  EXPECT_THAT(tank, HasSubstr("distance_m = 0.1\n"));
}

TEST_F(UnitsOfAMotion, AreRefusedWhereTheyDoNotFitTheAxis) {
  EXPECT_THAT(refusal({kJoint, "y_rad", "m"}),
              HasSubstr("reference[0].distance_m: given a way of an axis that turns; "
                        "allowed: distance_rad"));
  EXPECT_THAT(
      refusal({kTank, "y_m", "rad"}),
      HasSubstr("reference[0].distance_rad: given an angle of an axis that moves in a line; "
                "allowed: distance_m"));
  EXPECT_THAT(refusal({kJoint, "y_m", "rad"}),
              HasSubstr("start.y_m: given a unit that does not fit the axis; allowed: y_rad"));
  EXPECT_THAT(refusal({kTank, "y_rad", "m"}),
              HasSubstr("start.y_rad: given a unit that does not fit the axis; allowed: y_m"));
}

}  // namespace
}  // namespace towbench::harness
