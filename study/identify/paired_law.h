// Friction's law from the same experiment on a machine and on its simulated reference, whose law is
// known.
//
// What both runs of a pair share, stick-slip of the carriage on its transmission above all, falls
// out of their difference; what is left is by how much the two laws differ, to first order of
// (3.25):
//
//   T(w) - T'(w) = dC + dB w + dv d/dv (S - C) exp(-(w/v)^2)
//
// How far the differences lie from that tells how sure it is. Both directions of a speed are one
// difference: what the simulated reference does not do there it does in neither. And a carriage
// that sticks answers a change of the law by anything between nothing and twice what steady sliding
// does, so each shift may be off by itself, evenly spread.
#pragma once

#include <vector>

#include "study/identify/friction_law.h"

namespace towbench::study::identify {

struct LawShift {
  double coulomb_Nm = 0;  // machine less simulated reference
  double viscous_Nm_s_per_rad = 0;
  double stribeck_rad_per_s = 0;
  double coulomb_standard_error_Nm = 0;
  double viscous_standard_error = 0;
  double stribeck_standard_error = 0;
  bool found = false;
};

// Runs of the same speed and direction are a pair, those of a speed follow one another; at least
// six speeds. `excess_standard_error_Nm`: of S - C, which must be known: it does what v does.
[[nodiscard]] LawShift find_law_shift(const FrictionLaw& of_reference,
                                      double excess_standard_error_Nm,
                                      const std::vector<SteadyRun>& machine,
                                      const std::vector<SteadyRun>& reference);

}  // namespace towbench::study::identify
