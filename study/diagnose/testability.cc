#include "study/diagnose/testability.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace towbench::harness::diagnose {
namespace {

constexpr double kMatters = 0.05;

const Candidate* tried(const Selection& s, const Effect& effect) {
  for (const Candidate& c : s.last_round) {
    if (c.term.effect == &effect) {
      return &c;
    }
  }
  return nullptr;
}

bool accepted(const Selection& s, const Effect& effect) {
  return std::any_of(s.causes.begin(), s.causes.end(),
                     [&](const Cause& cause) { return cause.term.effect == &effect; });
}

// Of two effects of one name (chain_elasticity) the model has a use for one.
bool stated_in_another_way(const Selection& s, const Effect& effect) {
  return tried(s, effect) == nullptr &&
         std::any_of(s.last_round.begin(), s.last_round.end(),
                     [&](const Candidate& c) { return c.term.effect->name == effect.name; });
}

// Rms of the projected group when its coefficient is just detected.
double detectable_rms_N(const Candidate& c) {
  if (c.test.beta.size() == 0 || c.test.projected_rms <= 0) {
    return 0;
  }
  const Eigen::MatrixXd v = c.test.covariance;
  const double t2 = c.test.beta.dot(v.ldlt().solve(c.test.beta));
  return t2 > 0 ? kDetection * c.test.projected_rms / std::sqrt(t2) : 0;
}

}  // namespace

std::vector<NotTestable> find_not_testable(const Selection& s) {
  std::vector<NotTestable> out;
  const double force = s.after.force_rms_N;
  for (const Effect& effect : effect_library()) {
    if (accepted(s, effect) || stated_in_another_way(s, effect)) {
      continue;
    }
    const Candidate* c = tried(s, effect);
    if (c == nullptr) {
      out.push_back(
          {effect.name, "the model or the log lacks what it would be computed from", effect.needs});
    } else if (c->test.left_of_group < kLeastLeft) {
      out.push_back({effect.name,
                     fmt::format("only {:.1f} % of it differs from what the model already has",
                                 100 * c->test.left_of_group),
                     effect.needs});
    } else if (detectable_rms_N(*c) > kMatters * force) {
      out.push_back(
          {effect.name,
           fmt::format("it would have to reach {:.2g} N rms to be seen", detectable_rms_N(*c)),
           effect.needs});
    }
  }
  return out;
}

}  // namespace towbench::harness::diagnose
