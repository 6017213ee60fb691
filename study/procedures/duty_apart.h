// By how much two logs of the same motions differ in the duty that they took.
//
// Motion is set beside motion, each from where its reference sets off: a motion begins when the one
// before has come to rest, and what rests 40 ms later than its model would otherwise be compared
// with another place of the trapezoid.
#pragma once

#include "study/identify/recording.h"

namespace towbench::study::procedures {

// RMS over the motions that both have, % duty, of means over 20 ms: rounding is no model.
[[nodiscard]] double duty_apart_pct(const identify::Recording& one,
                                    const identify::Recording& other, core::Axis axis);
// Of the duty itself, likewise.
[[nodiscard]] double duty_rms_pct(const identify::Recording& log, core::Axis axis);

}  // namespace towbench::study::procedures
