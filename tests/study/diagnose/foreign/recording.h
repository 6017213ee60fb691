// A foreign machine under a plan, and what its bench would log of it, with the truth beside it.
#pragma once

#include <vector>

#include "study/prediction/run.h"
#include "tests/study/diagnose/foreign/effect.h"
#include "tests/study/diagnose/foreign/plan.h"

namespace towbench::tests::foreign {

// Means over the sample that follows; no bench would log them. They are of what an encoder without
// steps would read, and of the nominal law.
struct Truth {
  double t_s = 0;        // where the sample begins, since the session did
  double x_m = 0;        // there
  double lacking_N = 0;  // what the file's law leaves of the command
  double a_m_per_s2 = 0;
  double v_m_per_s = 0;
  double dry = 0;     // of the file's Coulomb friction, -1 to 1
  double moving = 0;  // share of the time
  double command_N = 0;
  double hand_N = 0;
};

struct Recording {
  RunPlan plan;
  std::vector<double> position_m;
  std::vector<double> input_units;
  std::vector<double> reference_m;  // empty: none
  double stated_gravity = 1;        // of a joint's, the share that its file states
  std::vector<Truth> truth;
};

inline constexpr double kCoarsestStep_s = 40e-6;

// Runs of one session share the state of what has a memory. A smaller `step_s` is a check.
[[nodiscard]] std::vector<Recording> record(const Machine& machine,
                                            const std::vector<Hidden>& hidden, const Plan& plan,
                                            std::uint64_t seed, double step_s = kCoarsestStep_s);

[[nodiscard]] study::diagnose::Run run_of(const Machine& machine, const Recording& recording);

}  // namespace towbench::tests::foreign
