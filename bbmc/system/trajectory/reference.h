// What a trajectory asks of one axis at one instant, in the global frame of that axis.
#pragma once

namespace towbench::bbmc {

struct Reference {
  double position_m = 0;
  double velocity_m_per_s = 0;
  double acceleration_m_per_s2 = 0;
};

}  // namespace towbench::bbmc
