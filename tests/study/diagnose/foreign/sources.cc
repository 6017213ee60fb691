#include "tests/study/diagnose/foreign/sources.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "study/commands/plant_model.h"
#include "tests/study/diagnose/bench_case.h"
#include "tests/study/diagnose/generator/hidden_force.h"
#include "tests/study/diagnose/hidden_case.h"

namespace towbench::tests::foreign {
namespace {

Key key_of(const std::string& name) {
  if (const Effect* effect = find(name)) {
    return {name, effect->right, effect->beside};
  }
  return {name, {name}, {}};
}

void describe(Posed& posed) {
  const auto& run = posed.request.runs.front();
  posed.rate_Hz = 1 / run.period_s;
  posed.resolution_m = run.resolution_m;
}

constexpr const char* kBenchPlant = "fixtures/plants/macs-nominal.toml";  // bench_case.cc's own

// What the tests' rigid axis hides; its one effect outside the library is called so.
std::vector<std::string> hidden_axis_effects() {
  std::vector<std::string> names;
  for (const HiddenEffectRow& row : hidden_effects()) {
    names.emplace_back(row.name);
  }
  return names;
}

void check(const std::vector<std::string>& names, const std::string& wished) {
  if (!wished.empty() && std::find(names.begin(), names.end(), wished) == names.end()) {
    throw std::runtime_error("this generator has no " + wished);
  }
}

std::string wished_or_drawn(const std::vector<std::string>& names, const Wish& wish, Dice& dice) {
  if (wish.kind == "none") return "";
  check(names, wish.effect);
  return wish.effect.empty() ? dice.pick(names) : wish.effect;
}

Posed pose_hidden_axis(const Wish& wish, std::uint64_t seed) {
  Dice dice(seed);
  HiddenAxis axis;
  axis.open_loop = wish.motion == "open_loop";
  const std::vector<std::string> names = hidden_axis_effects();
  axis.effect = wish.kind == "outside" ? "outside" : wished_or_drawn(names, wish, dice);
  if (wish.kind == "pair") {
    do {
      axis.second_effect = dice.pick(names);
    } while (find(axis.second_effect)->family == find(axis.effect)->family);
  }
  axis.size = axis.second_size = wish.strength;
  Posed posed;
  posed.machine = "hidden_axis";
  posed.plan = axis.open_loop ? "open_loop" : "drawn_reference";
  posed.is_outside = wish.kind == "outside";
  for (const std::string& name : {axis.effect, axis.second_effect}) {
    if (!name.empty()) posed.hidden.push_back(key_of(name));
  }
  posed.request.model = nominal_of(axis);
  posed.request.runs = {run_of(axis, make_hidden_log(axis, seed))};
  return posed;
}

Posed pose_bench(const Wish& wish, std::uint64_t seed) {
  if (wish.kind != "one" && wish.kind != "none") {
    throw std::runtime_error("the bench hides one effect or none");
  }
  Dice dice(seed);
  BenchCase one;
  one.seed = seed;
  one.strength = wish.strength;
  one.effect = wished_or_drawn(bench_effects(), wish, dice);
  Posed posed;
  posed.machine = "macs";
  posed.plan = "trapezoids";
  if (!one.effect.empty()) posed.hidden.push_back(key_of(one.effect));
  posed.request.model = study::load_plant_model(kBenchPlant, "y").model;
  posed.request.runs = {bench_run(one)};
  return posed;
}

}  // namespace

Posed pose(const Wish& wish, const DrawnCase& drawn) {
  Posed posed;
  for (const Hidden& hidden : drawn.hidden) {
    posed.hidden.push_back(key_of(hidden.name));
  }
  posed.is_outside = wish.kind == "outside";
  posed.machine = drawn.machine.kind;
  posed.plan = drawn.plan.words();
  std::set<std::string> motions;
  for (const RunPlan& run : drawn.plan.runs) {
    motions.insert(run.motion);
  }
  posed.motions.assign(motions.begin(), motions.end());
  posed.sessions = drawn.plan.sessions.size();
  posed.visible = drawn.visible;
  posed.share = drawn.share;
  posed.redrawn = drawn.redrawn;
  posed.request = request_of(drawn);
  describe(posed);
  return posed;
}

Posed pose(const std::string& generator, const Wish& wish, std::uint64_t seed) {
  if (generator == "foreign") {
    return pose(wish, draw_case(wish, seed));
  }
  Posed posed = generator == "bench" ? pose_bench(wish, seed) : pose_hidden_axis(wish, seed);
  posed.motions = {posed.plan};
  describe(posed);
  return posed;
}

}  // namespace towbench::tests::foreign
