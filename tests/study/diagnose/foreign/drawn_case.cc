#include "tests/study/diagnose/foreign/drawn_case.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/study/diagnose/foreign/beyond_laws.h"

namespace towbench::tests::foreign {
namespace {

constexpr int kMostDraws = 400;
// What the file's columns can make of it is no shape of its own.
constexpr double kLeastOff = 0.2;
constexpr double kLeastOutside = 0.02;  // of the command's rms, of what is to be told
// Of its rms, what no law of a textbook makes in this motion: less is that law.
constexpr double kLeastBeyond = 0.2;

std::vector<const Effect*> fitting(const Wish& wish, const Machine& machine) {
  std::vector<const Effect*> all;
  for (const Effect& effect : effects()) {
    const bool is_outside = effect.family == "outside";
    const bool wanted = wish.effect.empty()
                            ? !effect.by_name && is_outside == (wish.kind == "outside")
                            : effect.name == wish.effect;
    if (wanted && effect.fits(machine)) {
      all.push_back(&effect);
    }
  }
  return all;
}

// Two that are of one body at most, and of two families.
bool go_together(const Effect& one, const Effect& other) {
  return one.family != other.family && (one.right != other.right) &&
         (one.span == Span::kNone || one.span != other.span);
}

// Empty: this machine cannot have what is wished.
std::vector<Hidden> draw_effects(const Wish& wish, const Machine& machine, Dice& dice) {
  if (wish.kind == "none") {
    return {};
  }
  const std::vector<const Effect*> all = fitting(wish, machine);
  if (all.empty()) {
    return {};
  }
  const Effect* first = dice.pick(all);
  std::vector<Hidden> hidden{draw_hidden(first->name, wish.strength, dice)};
  if (wish.kind == "pair") {
    std::vector<const Effect*> seconds = fitting(Wish{}, machine);
    std::erase_if(seconds, [&](const Effect* one) { return !go_together(*first, *one); });
    hidden.push_back(draw_hidden(dice.pick(seconds)->name, wish.strength, dice));
  }
  return hidden;
}

// A hand's force does not pass the drive, so that its run contradicts the others.
bool contradicts(const DrawnCase& one) {
  return std::any_of(one.hidden.begin(), one.hidden.end(), [&](const Hidden& hidden) {
    return find(hidden.name)->family == "drive" && one.plan.has("hand");
  });
}

// Of less than a turn of its motor a ripple is a force by the place, or another weight of a joint.
bool is_part_of_a_turn(const DrawnCase& one) {
  const bool turns = one.machine.stroke_m > kTurn * one.machine.metres_per_motor_rad;
  return !turns && std::any_of(one.hidden.begin(), one.hidden.end(),
                               [](const Hidden& hidden) { return hidden.name == "torque_ripple"; });
}

// The effect's own force: without torque noise, and with every session as the file says.
std::vector<Recording> by_itself(const DrawnCase& one, const Hidden& alone) {
  Machine quiet = one.machine;
  quiet.torque_noise_N = 0;
  Plan plain = one.plan;
  for (Session& session : plain.sessions) {
    session.offset_N = 0;
    session.friction = 1;
  }
  return record(quiet, {alone}, plain, one.seed);
}

Visibility shown(const DrawnCase& one, const Hidden& alone) {
  return visibility(one.machine, by_itself(one, alone), find(alone.name)->span);
}

// The size at which the effect alone is as strong as wished.
bool resize(const DrawnCase& one, Hidden& alone, double times) {
  constexpr int kMostTries = 8;
  constexpr double kFarthest = 4;
  alone.strength = 1;
  for (int i = 0; i < kMostTries; ++i) {
    const double now = shown(one, alone).times;
    if (now > 0.85 * times && now < 1.15 * times) {
      return true;
    }
    alone.strength *= std::clamp(times / std::max(now, 1e-9), 1 / kFarthest, kFarthest);
    if (alone.strength < 0.02 || alone.strength > 2) {
      return false;  // a hundredth of what is physical, or more than that
    }
  }
  return false;
}

bool shows(DrawnCase& one, const Wish& wish) {
  one.visible = 1e300;
  one.share = 1e300;
  for (Hidden& alone : one.hidden) {
    if (wish.scale == Scale::kDetectable && !resize(one, alone, kFullTimes * wish.strength)) {
      return false;
    }
    const auto runs = by_itself(one, alone);
    const Span span = find(alone.name)->span;
    const Visibility seen = visibility(one.machine, runs, span);
    const double share = seen.force_N / seen.command_N;
    const bool is_shape = span != Span::kNone || seen.off >= kLeastOff;
    const bool is_large = wish.kind != "outside" || share >= kLeastOutside * wish.strength;
    const double least = wish.scale == Scale::kPhysical ? kVisible : 0;
    if (seen.times < least || !is_shape || !is_large) {
      return false;
    }
    if (wish.kind == "outside" && beyond_laws(one.machine, runs) < kLeastBeyond) {
      return false;
    }
    one.visible = std::min(one.visible, seen.times);
    one.share = std::min(one.share, share);
  }
  if (one.hidden.empty()) {
    one.visible = 0;
    one.share = 0;
  }
  return true;
}

}  // namespace

DrawnCase draw_case(const Wish& wish, std::uint64_t seed) {
  DrawnCase one;
  one.seed = seed;
  for (int draw = 0; draw < kMostDraws; ++draw) {
    Dice dice(seed, static_cast<std::uint64_t>(draw));
    one.redrawn = draw;
    one.machine =
        draw_machine(wish.machine.empty() ? dice.pick(machine_kinds()) : wish.machine, dice);
    one.hidden = draw_effects(wish, one.machine, dice);
    if (wish.kind != "none" && one.hidden.empty()) {
      continue;
    }
    one.plan = draw_plan(one.machine, wish.motion, dice);
    if (contradicts(one) || is_part_of_a_turn(one) || !shows(one, wish)) {
      continue;
    }
    one.runs = record(one.machine, one.hidden, one.plan, seed);
    if (is_sound(one.machine, one.runs)) {
      return one;
    }
  }
  throw std::runtime_error("no draw of " + std::to_string(kMostDraws) + " shows " + wish.effect +
                           " on " + (wish.machine.empty() ? "any machine" : wish.machine));
}

study::diagnose::Request request_of(const DrawnCase& one) {
  study::diagnose::Request request;
  request.model = nominal_model(one.machine, one.runs.front().stated_gravity);
  for (const Recording& run : one.runs) {
    (run.plan.held_out ? request.holdout : request.runs).push_back(run_of(one.machine, run));
  }
  return request;
}

}  // namespace towbench::tests::foreign
