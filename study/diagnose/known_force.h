// What a known force on the carriage says about the amplifier: the one thing that no motion shows.
//
// Where the amplifier gives rho times less than stated, the force that a log's commands are taken
// for is rho times too large, whatever it does: F_nominal = rho (M a + B v + C sgn v + b - P(t)).
// Of a push P(t) that is known, rho is the coefficient; M, B, C and b take the rest.
#pragma once

#include "study/prediction/interval.h"
#include "study/prediction/nominal_model.h"
#include "study/prediction/run.h"

namespace towbench::study::diagnose {

struct KnownForce {
  double force_N = 0;  // on the carriage, + towards max
  double from_s = 0;   // of the run
  double to_s = 0;
};

// rho with its 95 % interval (clustered); 1 when the amplifier is as stated, 1 / (1 + g) when its
// gain is off by g. `run` holds stretches with and without the push, each in both directions.
[[nodiscard]] Interval force_ratio(const NominalModel& model, const Run& run,
                                   const KnownForce& push);

}  // namespace towbench::study::diagnose
