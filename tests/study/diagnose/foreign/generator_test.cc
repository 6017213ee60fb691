// The foreign generator against closed forms: what it says is hidden, and nothing else, is in its
// logs.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/study/diagnose/foreign/beyond_laws.h"
#include "tests/study/diagnose/foreign/drawn_case.h"
#include "tests/study/diagnose/foreign/dry_bodies.h"
#include "tests/study/diagnose/foreign/score.h"

namespace towbench::tests::foreign {
namespace {

constexpr double kStep_s = 25e-6;

TEST(DryBodies, CoastDownEndsWhereCoulombFrictionSays) {
  DryBodies body({.mass_kg = 2, .v_m_per_s = 0.8}, {}, {});
  double t_s = 0;
  for (; body.motor().v_m_per_s > 0; t_s += kStep_s) {
    body.step(kStep_s, {}, {.motor_N = 1.5});
  }
  EXPECT_NEAR(body.motor().x_m, 2 * 0.8 * 0.8 / (2 * 1.5), 1e-5);
  EXPECT_NEAR(t_s, 2 * 0.8 / 1.5, 2 * kStep_s);
}

TEST(DryBodies, WhatSticksDoesNotCreep) {
  DryBodies body({.mass_kg = 2}, {}, {});
  for (int i = 0; i < 400'000; ++i) {
    const ForcePair held = body.step(kStep_s, {.motor_N = 0.999}, {.motor_N = 1});
    ASSERT_DOUBLE_EQ(held.motor_N, 0.999);
  }
  EXPECT_EQ(body.motor().x_m, 0);
  body.step(kStep_s, {.motor_N = 1.001}, {.motor_N = 1});
  EXPECT_GT(body.motor().v_m_per_s, 0);
}

TEST(DryBodies, BothBodiesStickOnAStretchedChain) {
  DryBodies bodies({.mass_kg = 1, .x_m = 1e-3}, {.mass_kg = 4}, {.stiffness_N_per_m = 2000});
  for (int i = 0; i < 40'000; ++i) {
    const ForcePair held = bodies.step(kStep_s, {}, {.motor_N = 2.1, .load_N = 2.1});
    ASSERT_NEAR(held.motor_N, -2, 1e-9);
    ASSERT_NEAR(held.load_N, 2, 1e-9);
  }
  EXPECT_EQ(bodies.stretch_m(), 1e-3);
}

// Free against free: the reduced mass on the spring, and no damping of the method's own.
TEST(DryBodies, TheChainSwingsAtItsFrequencyAndKeepsItsEnergy) {
  const double stiffness = 3000;
  const double reduced = 1.0 * 4.0 / 5.0;
  const double period_s = kTurn / std::sqrt(stiffness / reduced);
  DryBodies bodies({.mass_kg = 1, .x_m = 2e-3}, {.mass_kg = 4}, {.stiffness_N_per_m = stiffness});
  int turns = 0;
  double last_s = 0;
  double before = bodies.stretch_m();
  double largest = 0;
  for (double t_s = 0; turns < 50; t_s += kStep_s) {
    bodies.step(kStep_s, {}, {});
    const double stretch = bodies.stretch_m();
    if (before < 0 && stretch >= 0) {
      last_s = t_s;
      ++turns;
      largest = 0;
    }
    largest = std::max(largest, std::abs(stretch));
    before = stretch;
  }
  EXPECT_NEAR(last_s, (50 - 0.25) * period_s, 0.002 * period_s * 50);
  EXPECT_NEAR(bodies.motor().mass_kg * bodies.motor().v_m_per_s + 4 * bodies.load().v_m_per_s, 0,
              1e-12);
  const double speed2 =
      std::pow(bodies.motor().v_m_per_s, 2) / 2 + 4 * std::pow(bodies.load().v_m_per_s, 2) / 2;
  const double energy = speed2 + stiffness * before * before / 2;
  EXPECT_NEAR(energy, stiffness * 4e-6 / 2, 1e-6 * energy);
}

TEST(DryBodies, PlayIsCrossedFreely) {
  DryBodies bodies({.mass_kg = 1, .v_m_per_s = 0.1}, {.mass_kg = 4},
                   {.stiffness_N_per_m = 1e6, .damping_N_s_per_m = 300, .play_m = 2e-3});
  double t_s = 0;
  for (; bodies.load().v_m_per_s == 0; t_s += kStep_s) {
    ASSERT_LT(t_s, 1);
    bodies.step(kStep_s, {}, {});
  }
  EXPECT_NEAR(t_s, 1e-3 / 0.1, 2 * kStep_s);
  for (int i = 0; i < 4000; ++i) {
    bodies.step(kStep_s, {}, {});
  }
  EXPECT_NEAR(bodies.motor().v_m_per_s + 4 * bodies.load().v_m_per_s, 0.1, 1e-9);
  EXPECT_LT(bodies.motor().v_m_per_s, bodies.load().v_m_per_s);  // a flank never pulls
}

// Large swings: the complete elliptic integral of the first kind.
TEST(DryBodies, APendulumHasItsPeriod) {
  const double amplitude = 1.2;
  const double gravity = 5;
  DryBodies body({.mass_kg = 0.3, .x_m = amplitude}, {}, {});
  double t_s = 0;
  while (body.motor().x_m > 0) {
    body.step(kStep_s, {.motor_N = -gravity * std::sin(body.motor().x_m)}, {});
    t_s += kStep_s;
  }
  EXPECT_NEAR(t_s, std::sqrt(0.3 / gravity) * std::comp_ellint_1(std::sin(amplitude / 2)), 1e-4);
}

Machine stage() {
  Machine m;
  m.kind = "screw";
  m.input = "force";
  m.mass_kg = 3;
  m.viscous_N_s_per_m = 4;
  m.coulomb_N = 2;
  m.metres_per_motor_rad = 1e-3;
  m.metres_per_count = 1e-6;
  m.newton_per_unit = 1;
  m.unit_limit = 60;
  m.period_s = 1e-3;
  m.stroke_m = 0.4;
  m.top_speed_m_per_s = 0.3;
  m.acceleration_m_per_s2 = 2;
  return m;
}

Plan plan_of(const std::string& motion) {
  Plan plan;
  plan.runs = {{.motion = motion, .duration_s = 12, .seed = 7}};
  plan.sessions.resize(1);
  plan.loop = {.bandwidth_Hz = 5, .damping = 1, .integral = 0.2};
  return plan;
}

double rms_lacking(const std::vector<Recording>& runs) {
  double sum = 0;
  double count = 0;
  for (const Truth& truth : runs.front().truth) {
    sum += truth.moving > 0.99 ? truth.lacking_N * truth.lacking_N : 0;
    count += truth.moving > 0.99 ? 1 : 0;
  }
  return std::sqrt(sum / count);
}

// The balance of forces along the motion is an energy balance at every sample.
TEST(Recordings, NothingIsLackingWhereNothingIsHidden) {
  for (const std::string& motion : motion_names()) {
    EXPECT_LT(rms_lacking(record(stage(), {}, plan_of(motion), 1)), 1e-3) << motion;
  }
  Machine elastic = stage();
  elastic.kind = "elastic_chain";
  elastic.sprocket_radius_m = 0.03;
  elastic.chain_Hz = 11;
  EXPECT_LT(rms_lacking(record(elastic, {}, plan_of("multisine"), 1)), 1e-3);
  Machine joint = stage();
  joint.kind = "joint";
  joint.gravity_N = 6;
  EXPECT_LT(rms_lacking(record(joint, {}, plan_of("fast_laps"), 1)), 1e-3);
}

TEST(Recordings, AConstantForceIsLackingInItsSize) {
  const Hidden bias{.name = "constant_bias", .draw = 0.5};
  EXPECT_NEAR(rms_lacking(record(stage(), {bias}, plan_of("fast_laps"), 1)), 0.25 * 2, 0.02);
}

TEST(Recordings, AnotherStepLogsTheSame) {
  const auto coarse = record(stage(), {}, plan_of("fast_laps"), 1);
  const auto fine = record(stage(), {}, plan_of("fast_laps"), 1, kCoarsestStep_s / 8);
  double most = 0;
  for (std::size_t k = 0; k < coarse[0].position_m.size(); ++k) {
    most = std::max(most, std::abs(coarse[0].position_m[k] - fine[0].position_m[k]));
  }
  EXPECT_LT(most, 4e-6);
}

TEST(Recordings, ADeadTimeIsItsOwnLength) {
  const Hidden delay{.name = "transport_delay", .draw = 1};  // 6 ms
  const auto at_once = record(stage(), {}, plan_of("pulses"), 1);
  const auto late = record(stage(), {delay}, plan_of("pulses"), 1);
  const auto begins = [](const Recording& run) {
    std::size_t k = 0;
    while (run.truth[k].v_m_per_s == 0) ++k;
    return k;
  };
  EXPECT_EQ(begins(late[0]) - begins(at_once[0]), 6U);
}

// On the first kind of machine that can have it.
Machine machine_for(const Effect& effect) {
  for (const std::string& kind : machine_kinds()) {
    Dice dice(3);
    Machine machine = draw_machine(kind, dice);
    machine.torque_noise_N = 0;
    if (effect.fits(machine)) return machine;
  }
  ADD_FAILURE() << effect.name << " fits no machine";
  return stage();
}

TEST(Recordings, EachEffectTakesAForceThatTheFileLacks) {
  for (const Effect& effect : effects()) {
    const Machine machine = machine_for(effect);
    Dice dice(11);
    const Plan plan = plan_of("fast_laps");
    const Hidden hidden = draw_hidden(effect.name, 1, dice);
    const auto with = visibility(machine, record(machine, {hidden}, plan, 1), effect.span);
    const auto without = visibility(machine, record(machine, {}, plan, 1), effect.span);
    EXPECT_LT(without.force_N, 2e-3 * without.command_N) << effect.name;
    // Break-away shows where slow motion sticks, and hardly in laps.
    const double least = effect.name == "stiction" ? 1 : 4;
    EXPECT_GT(with.force_N, least * without.force_N) << effect.name;
  }
}

double beyond(const std::string& effect, const std::string& motion) {
  const Hidden hidden{.name = effect};
  return beyond_laws(stage(), record(stage(), {hidden}, plan_of(motion), 1));
}

// A law of a textbook leaves nothing; what is no law is none, unless the motion is too poor: on a
// sine a spring that creeps is a spring and a damper.
TEST(BeyondLaws, IsWhatNoLawMakes) {
  EXPECT_LT(beyond("position_viscous", "multisine"), 0.05);
  EXPECT_LT(beyond("quadratic_drag", "prbs"), 0.05);
  EXPECT_GT(beyond("outside_memory", "prbs"), 0.5);
  EXPECT_GT(beyond("outside_after_reversal", "multisine"), 0.5);
  EXPECT_LT(beyond("outside_memory", "sine"), 0.2);
}

// More dry friction at each reversal, gone where the stroke's ends are far.
TEST(Recordings, FrictionAfterAReversalFallsWithTheWay) {
  const Hidden hidden{.name = "outside_after_reversal", .draw = 0.5, .place = 0.5};
  const auto runs = record(stage(), {hidden}, plan_of("slow_laps"), 1);
  double most = 0;
  double last = 0;
  double direction = 0;
  for (const Truth& truth : runs.front().truth) {
    if (truth.moving < 1) continue;
    const double against = std::abs(truth.lacking_N);
    if (truth.v_m_per_s * direction < 0) {
      EXPECT_LT(last, 0.1 * 0.6 * 2);
    }
    direction = truth.v_m_per_s;
    most = std::max(most, against);
    last = against;
  }
  EXPECT_NEAR(most, 0.6 * 2, 0.1);
}

TEST(DrawnCases, AreTheSameForTheSameSeed) {
  const Wish wish{.kind = "pair"};
  const DrawnCase one = draw_case(wish, 5);
  const DrawnCase other = draw_case(wish, 5);
  EXPECT_EQ(one.plan.words(), other.plan.words());
  ASSERT_EQ(one.runs.size(), other.runs.size());
  EXPECT_EQ(one.runs.back().position_m, other.runs.back().position_m);
  EXPECT_NE(one.runs.back().position_m, draw_case(wish, 6).runs.back().position_m);
}

TEST(Judging, CountsWhatPhysicsCallsTheSame) {
  const std::vector<Key> mass{{"added_mass", {"added_mass", "inertia"}, {"coulomb"}}};
  const auto outcome = [&](const std::vector<Named>& causes) {
    Answer answer;
    answer.causes = causes;
    return judge(mass, false, answer).outcome;
  };
  EXPECT_EQ(outcome({{{"inertia"}, 0}}), Outcome::kRight);
  EXPECT_EQ(outcome({{{"stribeck", "inertia"}, 0}}), Outcome::kRight);
  EXPECT_EQ(outcome({{{"inertia"}, 0}, {{"coulomb"}, 0}}), Outcome::kRight);
  EXPECT_EQ(outcome({{{"inertia"}, 0}, {{"stribeck"}, 0}}), Outcome::kExtra);
  EXPECT_EQ(outcome({{{"stribeck"}, 0}}), Outcome::kFalse);
  EXPECT_EQ(outcome({}), Outcome::kMissed);
  EXPECT_EQ(outcome({{{"a", "b", "c", "d", "e", "inertia"}, 0}}), Outcome::kFalse);
  Answer refused;
  refused.refusal = "too_short";
  EXPECT_EQ(judge({}, false, refused).outcome, Outcome::kRefused);
  EXPECT_EQ(judge({{"outside", {}, {}}}, true, {}).outcome, Outcome::kMissed);
}

// A parameter that moved has no p-value, and counts as neither.
TEST(Judging, CountsHowOftenWhatHasAPValueIsWrong) {
  Answer answer;
  answer.causes = {
      {{"stribeck"}, 1e-4}, {{"inertia"}, 1e-4}, {{"stiction"}, 1e-40}, {{"viscous"}, 1}};
  Tally tally;
  tally.add(judge({{"added_mass", {"added_mass", "inertia"}, {}}}, false, answer).said);
  EXPECT_THAT(tally.words(), ::testing::HasSubstr("| 1e-06 to 1 | 2 | 1 | 50"));
  EXPECT_THAT(tally.words(), ::testing::HasSubstr("| 1e-100 to 1e-30 | 1 | 1 | 100"));
}

}  // namespace
}  // namespace towbench::tests::foreign
