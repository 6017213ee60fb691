// What the optimiser goes for in a round: which rule to bring nearest to breaking, by which faults.
//
// The margins of different rules have no common scale, so that the smallest of all hides the others
// (Zhang, Hasuo, Arcaini: Multi-armed bandits for Boolean connectives in hybrid system
// falsification, CAV 2019). So each rule has its own order of spaces.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/falsify/falsify_trial.h"
#include "harness/falsify/search_space.h"

namespace towbench::harness {

// A space, and a rule; an empty rule is all that is asked, as one number.
using SearchGoal = std::pair<std::size_t, std::string>;

// None: the fault did not take effect, or gave that rule no occasion.
[[nodiscard]] std::optional<double> margin_for(const FalsifyTrial& trial, const std::string& rule);

// Of the spaces that these trials sampled, that of the smallest margin first, the rules in turn. A
// rule's margin is compared with the usual one, the median over the experiment; a space with more
// than half of it is left out.
[[nodiscard]] std::vector<SearchGoal> search_goals(std::span<const FalsifyTrial> trials,
                                                   const std::vector<SearchSpace>& spaces);

}  // namespace towbench::harness
