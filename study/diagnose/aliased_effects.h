// Effects that the nominal structure can imitate: with one of them in the machine and every
// parameter as supplied, the refit moves parameters all the same. One-way data shows viscous
// asymmetry as another viscosity.
//
// Such an effect's columns lie in the span of the model's (less than kLeastLeft off it), so that it
// moves the parameters along W = (X'X)^-1 X' columns. It is an aliased effect when the shift delta
// from what was supplied is W beta but for chance or for what does not matter:
//   min over beta of (delta - W beta)' V^-1 (delta - W beta) < 4^2,  or 1 % of the force
#pragma once

#include <vector>

#include "study/diagnose/parameters.h"
#include "study/diagnose/selection.h"

namespace towbench::harness::diagnose {

// Adds to the class of each parameter that moved, to three members at most.
void find_aliased_effects(std::vector<ParameterShift>& shifts, const Selection& selection);

}  // namespace towbench::harness::diagnose
