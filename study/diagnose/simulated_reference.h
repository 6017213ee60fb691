// The simulated reference: the model under trial, run through the same experiment, measured with
// the same encoder.
//
// Everything that the processing does to a perfect model (differentiated counts, smoothed signs,
// noise fed back by the controller) it does to the simulated reference too, so it drops out of
//   r_c = (Y - X theta) - (Y_reference - X_reference theta).
//
// Its body, one or two, is axis_body.h's; it truly sticks.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "study/diagnose/control_law.h"
#include "study/diagnose/dataset.h"

namespace towbench::harness::diagnose {

struct SimulatedReference {
  Run run;
  ControlLaw::Kind law = ControlLaw::Kind::kTracking;  // the one that was used in the end
};

// Force that accepted effects demand at each sample, taken along the measured motion.
struct ExtraForce {
  Eigen::VectorXd on_motor_N;
  Eigen::VectorXd on_load_N;
};

// An input that the baseline does not hold is continued along its last slope: no delay to
// first order. `seed` places the encoder's grating under the start.
[[nodiscard]] SimulatedReference simulate_reference(const Dataset::Member& member,
                                                    const Theta& theta, const Baseline& baseline,
                                                    const ExtraForce& extra, const ControlLaw& law,
                                                    std::uint64_t seed);

}  // namespace towbench::harness::diagnose
