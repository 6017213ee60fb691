// Hides every effect under many seeds and prints what the diagnosis calls it.
//
//   diagnose_campaign [SEEDS [STRENGTH [EFFECT...]]]        in a rigid axis, by another generator
//   diagnose_campaign pairs [SEEDS [STRENGTH]]              two of different families; one a seed
//   diagnose_campaign bench [SEEDS [STRENGTH [EFFECT...]]]  in the emulator, under BBMC
//   diagnose_campaign honest [SEEDS [STRENGTH]]             what was stated as gained, and what
//                                                           another log of the machine shows
//
// SEEDS is how many, from 1, or which: 7-8.
// STRENGTH is a share of full size: of generator/hidden_force.cc, on the bench of bench_case.cc.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/random.h"
#include "tests/study/diagnose/bench_case.h"
#include "tests/study/diagnose/generator/hidden_force.h"
#include "tests/study/diagnose/hidden_case.h"

namespace {

using namespace towbench::tests;
using towbench::study::diagnose::Diagnosis;

using Families = std::vector<std::vector<std::string>>;

const Families& families() {
  static const Families kAll = [] {
    Families all;
    for (const auto& effect : hidden_effects()) {
      all.resize(std::max(all.size(), effect.family + 1));
      all[effect.family].emplace_back(effect.name);
    }
    return all;
  }();
  return kAll;
}

struct Seeds {
  int first = 1;
  int last = 3;
};

Seeds seeds_in(const char* text) {
  const char* dash = std::strchr(text, '-');
  return dash == nullptr ? Seeds{1, std::atoi(text)} : Seeds{std::atoi(text), std::atoi(dash + 1)};
}

std::vector<std::string> all_effects() {
  std::vector<std::string> all{""};
  for (const auto& effect : hidden_effects()) {
    all.emplace_back(effect.name);
  }
  all.emplace_back("outside");
  return all;
}

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string joined(const std::vector<std::string>& names) {
  std::string all = names.front();
  for (std::size_t i = 1; i < names.size(); ++i) all += "~" + names[i];
  return all;
}

// Why the effect was not named: what stopped it last, with its figures.
std::string what_stopped(const Diagnosis& d, const std::string& effect) {
  using namespace towbench::study::diagnose;
  std::string out;
  for (const towbench::study::logs::Finding& finding : d.findings) {
    out += finding.name + ": " + finding.sentence + "; ";
  }
  for (const Refused& r : d.refused) {
    if (r.effect == effect) {
      out += fmt::format("refused: gain {:.2f} % [{:.2f}, {:.2f}], p {:.1g}; ",
                         100 * r.gain99.value, 100 * r.gain99.low, 100 * r.gain99.high, r.p_value);
    }
  }
  for (const NotTestable& n : d.not_testable) {
    if (n.effect == effect) out += "not testable: " + n.why + "; ";
  }
  return out;
}

struct Tally {
  int runs = 0;
  int hit = 0;
  int unexplained = 0;
  int extra = 0;
  std::map<std::string, int> names;

  void add(const Diagnosis& d, const std::string& effect) {
    bool found = false;
    bool wrong = false;
    for (const auto& one : named(d)) {
      (holds(one, effect) ? found : wrong) = true;
      ++names[joined(one)];
    }
    const bool nothing_to_name = effect.empty() || effect == "outside";
    ++runs;
    if (wrong || !(found || nothing_to_name)) {
      fmt::print(stderr, "{} run {}: {}: {}\n", effect, runs, wrong ? "other names" : "not named",
                 found ? "" : what_stopped(d, effect));
    }
    hit += !wrong && (found || nothing_to_name) ? 1 : 0;
    extra += wrong ? 1 : 0;
    unexplained += d.unexplained ? 1 : 0;
  }
  void print(const std::string& effect) const {
    std::string list;
    for (const auto& [name, count] : names) list += fmt::format("{} x{}; ", name, count);
    fmt::print("| {} | {}/{} | {} | {} | {} |\n", effect.empty() ? "nothing" : effect, hit, runs,
               extra, unexplained, list);
    std::fflush(stdout);
  }
};

Diagnosis hidden(const std::string& effect, double strength, std::uint64_t seed, bool on_bench) {
  if (on_bench) {
    return diagnose_bench({effect, strength, seed});
  }
  HiddenAxis axis;
  axis.effect = effect;
  axis.size = strength;
  return diagnose_hidden(axis, seed);
}

void singles(const std::vector<std::string>& effects, const Seeds& seeds, double strength,
             bool on_bench) {
  fmt::print(
      "| hidden | right and alone | other names | unexplained | named |\n|---|---|---|---|---|\n");
  int hits = 0;
  int runs = 0;
  for (const auto& effect : effects) {
    Tally tally;
    for (int seed = seeds.first; seed <= seeds.last; ++seed) {
      tally.add(hidden(effect, strength, static_cast<std::uint64_t>(seed), on_bench), effect);
    }
    tally.print(effect);
    const bool counts = !effect.empty() && effect != "outside";
    hits += counts ? tally.hit : 0;
    runs += counts ? tally.runs : 0;
  }
  fmt::print("\nright and alone: {} of {}\n", hits, runs);
}

std::string drawn_from(const std::vector<std::string>& family, towbench::core::Random& random) {
  return family[static_cast<std::size_t>(random.uniform() * static_cast<double>(family.size()))];
}

// One constant force by two names, that may cancel: no log can tell them apart, or that they are
// there.
bool is_one_class(const HiddenAxis& axis) {
  const std::set<std::string> both{axis.effect, axis.second_effect};
  return both == std::set<std::string>{"coulomb_asymmetry", "constant_bias"};
}

void pairs(const Seeds& seeds, double strength) {
  int runs = 0;
  int both = 0;
  int any = 0;
  int alone = 0;
  fmt::print("| hidden | both named | nothing else | named |\n|---|---|---|---|\n");
  for (int seed = seeds.first; seed <= seeds.last; ++seed) {
    const auto drawn = static_cast<std::uint64_t>(seed);
    towbench::core::Random random(drawn);
    const auto count = static_cast<double>(families().size());
    const auto first = static_cast<std::size_t>(random.uniform() * count);
    const auto step = 1 + static_cast<std::size_t>(random.uniform() * (count - 1));
    HiddenAxis axis;
    axis.size = axis.second_size = strength;
    axis.effect = drawn_from(families()[first], random);
    axis.second_effect = drawn_from(families()[(first + step) % families().size()], random);
    if (is_one_class(axis)) {
      fmt::print("| {} + {} | one class: no pair | | |\n", axis.effect, axis.second_effect);
      continue;
    }
    ++runs;
    const Diagnosis d = diagnose_hidden(axis, drawn);
    const auto all = named(d);
    bool one = false;
    bool other = false;
    bool wrong = false;
    std::string list;
    for (const auto& names : all) {
      const bool is_one = holds(names, axis.effect);
      const bool is_other = holds(names, axis.second_effect);
      one = one || is_one;
      other = other || is_other;
      wrong = wrong || !(is_one || is_other);
      list += joined(names) + "; ";
    }
    both += one && other ? 1 : 0;
    any += one || other ? 1 : 0;
    alone += one && other && !wrong ? 1 : 0;
    fmt::print("| {} + {} | {} | {} | {} |\n", axis.effect, axis.second_effect,
               one && other ? "yes" : "no", wrong ? "no" : "yes", list);
    std::fflush(stdout);
    for (const auto& effect : {axis.effect, axis.second_effect}) {
      if (!(effect == axis.effect ? one : other)) {
        fmt::print(stderr, "seed {}: {} not named: {}\n", seed, effect, what_stopped(d, effect));
      }
    }
  }
  fmt::print("\nboth named: {} of {}; at least one: {}; both and nothing else: {}\n", both, runs,
             any, alone);
}

// What the causes gain on another log of the same machine that nobody has seen.
double gain_elsewhere(const HiddenAxis& axis, std::uint64_t seed) {
  constexpr std::uint64_t kFarAway = 1'000'000;
  HiddenAxis same = axis;
  same.machine = seed;
  towbench::study::diagnose::Request request;
  request.model = nominal_of(axis);
  request.runs = {run_of(axis, make_hidden_log(axis, seed))};
  request.holdout = {run_of(same, make_hidden_log(same, seed + kFarAway))};
  return towbench::study::diagnose::diagnose(request).scored.gain99.value;
}

void honest(const Seeds& seeds, double strength) {
  std::vector<double> flattery;
  double stated = 0;
  for (const auto& effect : all_effects()) {
    HiddenAxis axis;
    axis.effect = effect;
    axis.size = strength;
    for (int i = seeds.first; i <= seeds.last; ++i) {
      const auto seed = static_cast<std::uint64_t>(i);
      const Diagnosis d = diagnose_hidden(axis, seed);
      if (!d.causes.empty()) {
        const double here = d.scored.gain99.value;
        const double there = gain_elsewhere(axis, seed);
        flattery.push_back(here - there);
        stated += here;
        fmt::print("| {} | {} | {:.2f} % | {:.2f} % |\n", effect, seed, 100 * here, 100 * there);
        std::fflush(stdout);
      }
    }
  }
  const auto n = static_cast<double>(flattery.size());
  double mean = 0;
  double square = 0;
  for (const double one : flattery) {
    mean += one / n;
    square += one * one / n;
  }
  fmt::print("\n{} logs with a cause: stated {:.2f} %, more than elsewhere by {:.2f} +- {:.2f} %\n",
             flattery.size(), 100 * stated / n, 100 * mean,
             100 * std::sqrt((square - mean * mean) / n));
}

}  // namespace

int main(int argc, char** argv) {
  const std::string kind = argc > 1 ? argv[1] : "";
  if (kind == "bench" || kind == "pairs" || kind == "honest") {
    --argc;
    ++argv;
  }
  const Seeds seeds = argc > 1 ? seeds_in(argv[1]) : Seeds{};
  const double strength = argc > 2 ? std::atof(argv[2]) : 1.0;
  if (kind == "pairs") {
    pairs(seeds, strength);
    return 0;
  }
  if (kind == "honest") {
    honest(seeds, strength);
    return 0;
  }
  std::vector<std::string> effects(argv + std::min(argc, 3), argv + argc);
  if (effects.empty()) {
    effects = kind == "bench" ? bench_effects() : all_effects();
    if (kind == "bench") effects.insert(effects.begin(), std::string());
  }
  for (auto& effect : effects) {
    if (effect == "nothing") effect.clear();
  }
  singles(effects, seeds, strength, kind == "bench");
  return 0;
}
