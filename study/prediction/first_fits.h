// Effects without which a fit ends so far from the truth that its derivatives there mean nothing.
// They are fitted from the stated model, before the other effects are screened.
#pragma once

#include "study/prediction/screening.h"

namespace towbench::study::diagnose {

inline constexpr double kFresh = 0.3;  // gain at which they are believed whatever screening says

// All that the other axes of the log do at once: an arm's joint may feel more of them than of
// itself.
void accept_others(Frame& frame, const Model& start, double least_errors, State& now);
// Where they gain so much, `least_errors` standard errors above nothing, they are in `now`.
void accept_structural(Frame& frame, const Model& start, double least_errors, State& now);
// The best clip of the drive; whether there is one.
[[nodiscard]] bool accept_clip(const Frame& frame, const Model& start, double least_errors,
                               State& now);

}  // namespace towbench::study::diagnose
