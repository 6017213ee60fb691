// The closed form of the position-blind model's bias, against numbers worked out by hand and
// against the model itself on friction computed here.
#include "study/recovery/tow/blind_model_bias.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace towbench::study {
namespace {

using identify::TowStretch;

emulator::AxisParameters axis_with_ridge() {
  emulator::AxisParameters axis;
  for (const auto& [place, level] : {std::pair{0.0, 0.0}, {2.0, 1.6e-3}, {4.0, 0.0}}) {
    (void)axis.friction.position.position_m.push_back(place);
    (void)axis.friction.position.friction_Nm.push_back(level);
  }
  return axis;
}

constexpr double kMetresPerRad = 0.050 / (1539.0 / 44.0);

TEST(MeanPositionFriction, IsTheIntegralOverTheStretch) {
  const auto axis = axis_with_ridge();
  EXPECT_NEAR(mean_position_friction_Nm(axis, 0.0, 2.0), 0.8e-3, 1e-12);
  EXPECT_NEAR(mean_position_friction_Nm(axis, 2.0, 0.0), 0.8e-3, 1e-12);
  EXPECT_NEAR(mean_position_friction_Nm(axis, 1.0, 3.0), 1.2e-3, 1e-12);
  EXPECT_NEAR(mean_position_friction_Nm(axis, 0.5, 0.5), 0.4e-3, 1e-12);
  EXPECT_NEAR(mean_position_friction_Nm(axis, 4.0, 5.0), 0.0, 1e-12);
  EXPECT_EQ(mean_position_friction_Nm({}, 0.0, 1.0), 0.0);
}

TEST(BlindModelBias, IsZeroWhereOneTowsWhatOneIdentified) {
  const auto axis = axis_with_ridge();
  const std::array<TowStretch, 3> same{{{0.1, 0.5, 1.5}, {0.3, 0.5, 1.5}, {0.5, 0.5, 1.5}}};
  EXPECT_NEAR(blind_model_drag_bias(axis, same, same), 0.0, 1e-9);
}

// Friction 0.4e-3 N m higher on the tow than on the identification, at every speed: dF is constant,
// dD = dF sum v^2 / sum v^4.
TEST(BlindModelBias, IsPositiveWhereFrictionIsHigherThanWhereOneIdentified) {
  const auto axis = axis_with_ridge();
  const std::array<TowStretch, 2> low{{{0.2, 0.0, 1.0}, {0.4, 0.0, 1.0}}};   // mean 0.4e-3
  const std::array<TowStretch, 2> high{{{0.3, 0.5, 1.5}, {0.5, 0.5, 1.5}}};  // mean 0.8e-3
  const double force_N = 0.4e-3 / kMetresPerRad;
  const double expected = force_N * (0.09 + 0.25) / (0.0081 + 0.0625);
  EXPECT_NEAR(blind_model_drag_bias(axis, low, high), expected, 1e-6);
  EXPECT_NEAR(blind_model_drag_bias(axis, high, low), -force_N * (0.04 + 0.16) / (0.0016 + 0.0256),
              1e-6);
}

TEST(BlindModelBias, KnowsThatSlowTowsFeelStribeck) {
  auto axis = axis_with_ridge();
  axis.friction.position.position_m.clear();
  axis.friction.position.friction_Nm.clear();
  const std::array<TowStretch, 2> fast{{{0.2, 0.0, 1.0}, {0.4, 0.0, 1.0}}};
  const std::array<TowStretch, 1> slow{{{0.005, 0.0, 1.0}}};  // 3.5 rad/s of 6
  const double ratio = 0.005 / kMetresPerRad / axis.friction.stribeck_speed_rad_per_s;
  const double force_N = (axis.friction.breakaway_Nm - axis.coulomb_friction_Nm) *
                         std::exp(-ratio * ratio) / kMetresPerRad;
  EXPECT_NEAR(blind_model_drag_bias(axis, fast, slow), force_N / (0.005 * 0.005), 1e-3);
}

}  // namespace
}  // namespace towbench::study
