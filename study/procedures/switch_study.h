// Where the two switches of an axis stand, from a log in which homing met both.
//
// At the edge the motor leads the carriage by the transmission's stretch, and the motor feels it:
//
//   lead = (tau - f_m(w) - J_m w') / k - (2 zeta / w_0) lead'
//
// tau by the duty at the edge, f_m the motor's own friction at its own speed, k = w_0^2 J_m J_l /
// J; the second and the last term matter where the carriage sticks and slips, and there lead' is
// taken from tau'.
//
// f_m is the share of what does not belong to the place, so friction near the switch need not be
// known: it is in tau.
#pragma once

#include <vector>

#include "study/identify/switch_edges.h"
#include "study/procedures/procedure.h"

namespace towbench::study::procedures {

// What the transmission does between motor and carriage, as far as it is known.
struct Transmission {
  double inertia_kg_m2 = 0;
  double rotor_kg_m2 = 0;
  double resonance_Hz = 0;
  double damping_ratio = 0;
  double carriage_share = 0;
  double common_Nm = 0;  // dry friction that does not belong to the place
  double excess_Nm = 0;
  double stribeck_rad_per_s = 0;
  double viscous_Nm_s_per_rad = 0;
  double torque_per_duty_Nm = 0;
};

// One of them that may be off, and by how much.
struct Doubt {
  double Transmission::*what = nullptr;
  double standard_error = 0;
};

struct KnownTransmission {
  Transmission transmission;
  std::vector<Doubt> doubts;
  bool identified = false;  // false: some of it is only believed, and may be off by a fifth
};
[[nodiscard]] KnownTransmission known_transmission(const ProcedureContext& context);

// Distance between the switches by one kind of approach.
struct Distance {
  double counts = 0;
  double standard_error_counts = 0;
  double alike_counts = 0;  // the part of it that no repeat takes away: what the slip hides
};

// Of one play: where its switches stand, in counts of one frame.
//
// At the approach that counts the carriage may stick and slip on its transmission, and then a
// switch meets it in a slip, when the stretch changes by ten counts a millisecond. The search is
// too fast to stick, and known to a row's way. The surer of the two decides.
struct Edges {
  Distance slow;            // by the approaches that count
  Distance fast;            // by the searches
  double motor_counts = 0;  // between the motor's counts at the slow edges

  [[nodiscard]] Distance weighed() const noexcept;
};

class SwitchStudy {
 public:
  // All outlive this. The first approach is to the min switch, the second to the max.
  SwitchStudy(const identify::Recording& data, core::Axis axis,
              const std::vector<identify::SwitchApproach>& approaches);

  [[nodiscard]] Edges edges(const Transmission& transmission) const;
  // How far the motor ran beyond where it met the switch.
  [[nodiscard]] double beyond_m(const identify::SwitchApproach& approach) const;

 private:
  // What the motor and its drive do at an edge.
  struct Moment {
    double torque_Nm = 0;  // outward, as the speed
    double torque_Nm_per_s = 0;
    double speed_rad_per_s = 0;
    double acceleration_rad_per_s2 = 0;
    double acceleration_standard_error = 0;  // of it, by the encoder's rounding
  };
  // By which the motor is ahead of the carriage.
  struct Lead {
    double counts = 0;
    double rounding_counts = 0;  // standard errors
    double hidden_counts = 0;
  };
  [[nodiscard]] Moment moment_at(const Transmission& transmission,
                                 const identify::SwitchApproach& approach, std::size_t edge) const;
  [[nodiscard]] Lead lead(const Transmission& transmission,
                          const identify::SwitchApproach& approach, std::size_t edge) const;
  [[nodiscard]] Distance between(const Transmission& transmission,
                                 std::size_t identify::SwitchApproach::*edge) const;

  const identify::Recording& data_;
  core::Axis axis_;
  const std::vector<identify::SwitchApproach>& approaches_;
  std::vector<double> counts_;  // in one frame
};

}  // namespace towbench::study::procedures
