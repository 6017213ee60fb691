#include "study/diagnose/testability.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "study/prediction/units.h"

namespace towbench::study::diagnose {
namespace {

constexpr double kMatters = 0.05;

constexpr double kLeastLeft = 0.05;

const Candidate* tried(const Search& s, const Effect& effect) {
  for (const Candidate& c : s.refused) {
    if (c.effect == &effect) {
      return &c;
    }
  }
  return nullptr;
}

bool accepted(const Search& s, const Effect& effect) {
  return std::any_of(s.causes.begin(), s.causes.end(),
                     [&](const Cause& cause) { return cause.effect == &effect; });
}

// Of two effects of one name (chain_elasticity) the model has a use for one.
bool stated_in_another_way(const Search& s, const Effect& effect) {
  return tried(s, effect) == nullptr &&
         std::any_of(s.refused.begin(), s.refused.end(),
                     [&](const Candidate& c) { return c.effect->name == effect.name; });
}

bool repeats(const std::vector<NotTestable>& out, const Effect& effect) {
  return std::any_of(out.begin(), out.end(),
                     [&](const NotTestable& entry) { return entry.effect == effect.name; });
}

// Rms of what the effect makes of its own when it is just detected.
double detectable_rms_N(const Search& s, const Candidate& c) {
  const double to_force = s.final.fitted.model.parameters[Key::kMass] * s.bandwidth * s.bandwidth;
  return c.test.statistic > 0 ? kDetection * to_force * c.test.rms / std::sqrt(c.test.statistic)
                              : 0;
}

}  // namespace

std::vector<NotTestable> find_not_testable(const Search& s) {
  std::vector<NotTestable> out;
  const double force = s.context.input_rms_N;
  for (const Effect& effect : effects()) {
    if (accepted(s, effect) || stated_in_another_way(s, effect) || repeats(out, effect) ||
        effect.other >= std::max<std::ptrdiff_t>(1, std::ssize(s.context.others))) {
      continue;
    }
    const Candidate* c = tried(s, effect);
    if (c == nullptr) {
      if (!effect.grid(s.context).empty()) continue;  // in another's place, or dropped
      out.push_back(
          {effect.name, "the model or the log lacks what it would be computed from", effect.needs});
    } else if (c->test.own_share < kLeastLeft) {
      out.push_back({effect.name,
                     fmt::format("only {:.1f} % of it differs from what the model already has",
                                 100 * c->test.own_share),
                     effect.needs});
    } else if (detectable_rms_N(s, *c) > kMatters * force) {
      out.push_back({effect.name,
                     fmt::format("it would have to reach {:.2g} {} rms to be seen",
                                 detectable_rms_N(s, *c), units_of(s.context.stated).force),
                     effect.needs});
    }
  }
  return out;
}

}  // namespace towbench::study::diagnose
