// Two joints of an arm, one behind the other, under PD control: Lagrange's equations of two rigid
// links (Spong, Hutchinson, Vidyasagar 2006, 7.3), written in closed form and integrated by RK4.
// Shares no code with what judges it.
#pragma once

#include <cstdint>
#include <vector>

namespace towbench::tests {

//   M11 = a + 2 b cos q2,  M12 = d + b cos q2,  M22 = d
struct TwoLinkArm {
  double a_kg_m2 = 1.8;
  double b_kg_m2 = 0.35;
  double d_kg_m2 = 0.4;
  double weight_1_Nm = 0;  // G1 sin q1 + G2 sin(q1 + q2) on the first, the latter on both
  double weight_2_Nm = 0;
  double viscous_Nm_s_per_rad = 2.0;  // of each
  double coulomb_Nm = 1.5;            // of each
  double counts_per_rad = 20000;
  double period_s = 1e-3;
  double duration_s = 16;
  bool second_moves = true;
  double second_share = 1;  // of how far its reference goes
};

struct ArmLog {
  std::vector<double> time_s, q1_rad, q2_rad, torque1_Nm, torque2_Nm;
};

// Drawn sums of sines as references of both joints.
[[nodiscard]] ArmLog make_arm_log(const TwoLinkArm& arm, std::uint64_t seed);

}  // namespace towbench::tests
