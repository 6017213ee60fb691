// Where the two switches of an axis stand, from a log in which homing met both.
//
// At the edge the motor leads the carriage by the chain's stretch, and the motor feels it:
//
//   lead = (tau - f_m(w)) / k     tau by the duty at the edge, f_m the motor's own friction,
//                                 k = w_0^2 J_m J_l / J
//
// f_m is the share of what does not belong to the place, so friction near the switch need not be
// known: it is in tau.
#pragma once

#include <vector>

#include "harness/identify/switch_edges.h"
#include "harness/procedures/procedure.h"

namespace towbench::harness::procedures {

// What the chain does between motor and carriage, as far as it is known.
struct Chain {
  double inertia_kg_m2 = 0;
  double rotor_kg_m2 = 0;
  double resonance_Hz = 0;
  double carriage_share = 0;
  double common_Nm = 0;  // dry friction that does not belong to the place
  double excess_Nm = 0;
  double stribeck_rad_per_s = 0;
  double viscous_Nm_s_per_rad = 0;
  double torque_per_duty_Nm = 0;
};

// One of them that may be off, and by how much.
struct Doubt {
  double Chain::*what = nullptr;
  double deviation = 0;
};

struct KnownChain {
  Chain chain;
  std::vector<Doubt> doubts;
  bool identified = false;  // false: some of it is only believed, and may be off by a fifth
};
[[nodiscard]] KnownChain known_chain(const ProcedureContext& context);

// Of one play: where its switches stand, in counts of one frame.
struct Edges {
  double slow_counts = 0;   // between the switches, by the approaches that count
  double fast_counts = 0;   // the same by the searches, which are known to a row's way only
  double motor_counts = 0;  // between the motor's counts at the slow edges
};

class SwitchStudy {
 public:
  // All outlive this. The first approach is to the min switch, the second to the max.
  SwitchStudy(const identify::Recording& data, core::Axis axis,
              const std::vector<identify::SwitchApproach>& approaches);

  [[nodiscard]] Edges edges(const Chain& chain) const;
  // How far the motor ran beyond where it met the switch.
  [[nodiscard]] double beyond_m(const identify::SwitchApproach& approach) const;

 private:
  [[nodiscard]] double duty_at_pct(const Chain& chain, std::size_t edge) const;
  [[nodiscard]] double lead_counts(const Chain& chain, const identify::SwitchApproach& approach,
                                   std::size_t edge) const;

  const identify::Recording& data_;
  core::Axis axis_;
  const std::vector<identify::SwitchApproach>& approaches_;
  std::vector<double> counts_;  // in one frame
};

}  // namespace towbench::harness::procedures
