// Which other effects explain this data as well as an accepted cause does: its class.
//
// An alternative is one whose projected columns can make the cause's projected contribution (cosine
// above 0.97), or most of it (0.85) while it explains within 3 % as much in sample and predicts
// held-out data within 5 %. Of a weak cause chance decides which of its kin explains most: one that
// makes most of the contribution and does not predict worse for certain is an alternative too.
#pragma once

#include "study/diagnose/candidates.h"
#include "study/diagnose/gates.h"
#include "study/diagnose/selection.h"

namespace towbench::harness::diagnose {

inline constexpr double kLikeness = 0.97;
inline constexpr std::size_t kMostAlternatives =
    2;  // a class across families has three members at most

// Of the cause `which` of `stand`, the others of it kept.
[[nodiscard]] std::vector<Alternative> find_alternatives(const Trial& stand, std::size_t which,
                                                         const Gates& gates,
                                                         Candidates& candidates);

}  // namespace towbench::harness::diagnose
