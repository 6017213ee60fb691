#include "tests/study/diagnose/foreign/plan.h"

#include <algorithm>

namespace towbench::tests::foreign {
namespace {

constexpr double kMostSamples = 120'000;  // of all runs

void draw_runs(Plan& plan, const Machine& machine, const std::string& motion, Dice& dice) {
  const int count = dice.whole(1, 6);
  const double each_s = count == 1 ? dice.between(20, 40) : dice.between(8, 22);
  const double most_s = kMostSamples * machine.period_s / count;
  for (int i = 0; i < count; ++i) {
    RunPlan run;
    run.motion = motion.empty() ? dice.pick(motion_names()) : motion;
    run.duration_s = std::min(most_s, each_s * dice.between(0.8, 1.2));
    run.seed = dice.bits();
    plan.runs.push_back(run);
  }
  if (count > 1 && dice.chance(0.5)) {
    plan.runs[static_cast<std::size_t>(dice.whole(0, count - 1))].held_out = true;
  }
}

// Sessions differ by what averages to nothing over the runs that are fitted, so that the file is
// right of the machine.
void draw_sessions(Plan& plan, const Machine& machine, Dice& dice) {
  const bool anew = plan.runs.size() > 1 && dice.chance(0.5);
  const double pause_s = dice.between(2, 60);
  double clock_s = 0;
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    plan.runs[i].session = anew ? i : 0;
    plan.runs[i].start_s = anew ? 0 : clock_s;
    clock_s += plan.runs[i].duration_s + pause_s;
  }
  plan.sessions.resize(anew ? plan.runs.size() : 1);
  const double turn_m = machine.joint() ? machine.metres_per_count
                                        : kTurn * std::max(machine.metres_per_motor_rad, 1e-5);
  double offset_N = 0;
  double friction = 0;
  double fitted = 0;
  for (std::size_t i = 0; i < plan.sessions.size(); ++i) {
    Session& session = plan.sessions[i];
    session.origin_m = dice.between(-0.5, 0.5) * turn_m;
    if (anew) {
      session.offset_N = dice.between(-0.08, 0.08) * machine.coulomb_N;
      session.friction = 1 + dice.between(-0.08, 0.08);
      const double weight = plan.runs[i].held_out ? 0 : 1;
      offset_N += weight * session.offset_N;
      friction += weight * (session.friction - 1);
      fitted += weight;
    }
  }
  for (std::size_t i = 0; anew && i < plan.sessions.size(); ++i) {
    if (!plan.runs[i].held_out) {
      plan.sessions[i].offset_N -= offset_N / fitted;
      plan.sessions[i].friction -= friction / fitted;
    }
  }
}

void draw_loop(Plan& plan, const Machine& machine, Dice& dice) {
  const bool stiff = dice.chance(0.5);
  const bool well_tuned = dice.chance(0.7);
  Loop& loop = plan.loop;
  loop.bandwidth_Hz = stiff ? dice.between(5, 12) : dice.between(1, 3);
  loop.damping = well_tuned ? dice.between(0.8, 1.1) : dice.between(0.3, 0.5);
  loop.integral = dice.chance(0.7) ? dice.between(0.1, well_tuned ? 0.3 : 0.5) : 0;
  loop.feedforward = dice.chance(0.4) ? dice.between(0.7, 1.0) : 0;
  loop.bandwidth_Hz = std::min(loop.bandwidth_Hz, 1 / (30 * machine.period_s));
  if (machine.sprocket_radius_m > 0) {
    loop.bandwidth_Hz = std::min(loop.bandwidth_Hz, 3.5);  // a chain may swing from 9 Hz on
  }
  // One count must not make much of the force.
  constexpr double kMostOfForce = 0.1;
  const double most_N = kMostOfForce * (machine.coulomb_N + machine.inertial_N());
  while (5 * machine.mass_kg * std::pow(kTurn * loop.bandwidth_Hz, 2) * machine.metres_per_count >
         most_N) {
    loop.bandwidth_Hz *= 0.8;
  }
  plan.with_reference = dice.chance(0.7);
}

}  // namespace

const std::vector<std::string>& motion_names() {
  static const std::vector<std::string> kNames{
      "slow_laps", "fast_laps", "one_way", "stairs", "sine", "multisine", "steps",
      "prbs",      "pulses",    "coast",   "relay",  "hand", "pushed"};
  return kNames;
}

bool Plan::has(const std::string& motion) const {
  return std::any_of(runs.begin(), runs.end(),
                     [&](const RunPlan& run) { return run.motion == motion; });
}

std::string Plan::words() const {
  std::string all;
  for (const RunPlan& run : runs) {
    all += (all.empty() ? "" : "+") + run.motion + (run.held_out ? "(h)" : "");
  }
  return all;
}

Plan draw_plan(const Machine& machine, const std::string& motion, Dice& dice) {
  Plan plan;
  draw_runs(plan, machine, motion, dice);
  draw_sessions(plan, machine, dice);
  draw_loop(plan, machine, dice);
  return plan;
}

}  // namespace towbench::tests::foreign
