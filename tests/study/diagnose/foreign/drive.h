// From a commanded force to the force that arrives: steps, dead time, lag, and what an effect makes
// of it.
#pragma once

#include <vector>

#include "tests/study/diagnose/foreign/effect.h"

namespace towbench::tests::foreign {

// In the units of the log: limited, and in the steps of its converter.
[[nodiscard]] double in_steps(const Machine& machine, double units);

class Drive {
 public:
  Drive(const Machine& machine, const std::vector<Law>& laws);

  void command(double command_N);  // held for the coming sample
  double step(double h_s, const Now& now);
  [[nodiscard]] double force_N() const { return force_N_; }

 private:
  const std::vector<Law>& laws_;
  double period_s_;
  double dead_time_s_ = 0;
  double lag_s_ = 0;
  std::vector<double> commands_N_;  // of all samples
  double since_s_ = 0;              // of the present sample
  double lagged_N_ = 0;
  bool begun_ = false;
  double force_N_ = 0;
};

}  // namespace towbench::tests::foreign
