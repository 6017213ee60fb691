// Where the law of an elastic axis's load is known: where it is known which way both bodies go.
//
// The load's speed is the motor's less what the stretch changes by, and that is known to as much as
// the stiffness is: slower than a share of it the load may stand, and what holds a body that stands
// is not its sliding friction. The law holds at every sample by itself, so what is not known is
// taken out before the filter; after it, it would have spread over what is. A body that turns at
// speed, within a tenth of the smoothing's period, does not stand.
#pragma once

#include <Eigen/Core>

#include "study/diagnose/signals.h"

namespace towbench::harness::diagnose {

// One a sample: 0 where a body may stand and as far around as the smoothing reaches, 1 elsewhere, a
// ramp as wide as that reach between.
[[nodiscard]] Eigen::VectorXd known_law(const Signals& motor, const Signals& load,
                                        double smoothing_Hz);

}  // namespace towbench::harness::diagnose
