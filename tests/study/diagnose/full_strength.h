// How strong a hidden effect is, by definition: the rms of its force off the model's own columns,
// in units of what the log could just detect.
//
// The force is the generator's truth (what the nominal law lacks along the motion), passed through
// the diagnosis' filter and rows. Just detectable is what passes the method's documented gates:
// kDetection standard errors of its amplitude (HAC, from what the log leaves once the force is
// taken off) and the least gain. An effect inside the span of the model's columns can only be seen
// against the model as supplied: its whole force counts, and must reach 1 % of the log's, as must
// what is to be called unexplained.
#pragma once

#include <cstdint>

#include "tests/study/diagnose/generator/hidden_axis.h"

namespace towbench::tests {

inline constexpr double kFull = 5;  // times detectable

[[nodiscard]] double times_detectable(const HiddenAxis& axis, const HiddenLog& log);

// The axis with each of its effects at `share` of full strength, sized alone on the seed's motion.
[[nodiscard]] HiddenAxis at_strength(HiddenAxis axis, double share, std::uint64_t seed);

}  // namespace towbench::tests
