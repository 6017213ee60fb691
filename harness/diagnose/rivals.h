// Which other effects explain this data as well as an accepted cause does: its class.
//
// A rival is one whose projected columns can make the cause's projected contribution (cosine above
// 0.97), or that explains within 3 % as much in sample and predicts held-out data within 5 %.
#pragma once

#include "harness/diagnose/selection.h"

namespace towbench::harness::diagnose {

inline constexpr double kLikeness = 0.97;
inline constexpr std::size_t kMostRivals = 2;  // a class across families has three members at most

// Held-out rms that the model would have with `term` in the cause's place.
using HeldOutRms = std::function<double(const Term& term)>;

[[nodiscard]] std::vector<Rival> find_rivals(const Evidence& before, const Candidate& cause,
                                             const std::vector<Candidate>& others,
                                             double cause_heldout_rms, const HeldOutRms& rms);

}  // namespace towbench::harness::diagnose
