// The extended model set in motion against held-out data: step 6 of docs/theory/diagnosis.md.
//
// Windows. From a measured state (the load's by its own law, where there is one) the model is given
// the measured input for half a second and nothing else: how far from the measured place it ends is
// its position error. No controller pulls it back, so force that is wrong shows as way.
//
// Closed loop. The model runs through the whole log under the law that was read off it, or a stiff
// law that follows the measured motion; what the law has to command differs from the log's input by
// the force error, through the filter of every other column.
//
// Both of the model as it was supplied and as extended, each with what a session shifts calibrated
// alike (heldout.h).
#pragma once

#include <cstdint>

#include "study/diagnose/heldout.h"

namespace towbench::harness::diagnose {

inline constexpr double kWindow_s = 0.5;
inline constexpr double kBetweenStarts_s = 0.1;  // windows overlap; the bootstrap's blocks know

// Rms before and after, and the gain as a share with its 95 % interval.
struct Improvement {
  double before_rms = 0;
  double after_rms = 0;
  Interval gain;
};

struct Confirmation {
  Eigen::Index windows = 0;  // 0: no stretch of the data was long enough; then position is empty
  Improvement position_m{};  // after a window
  Improvement force_N{};     // closed loop
  ControlLaw::Kind law = ControlLaw::Kind::kTracking;
};

[[nodiscard]] Confirmation confirm(const HeldOut& heldout, const Context& context,
                                   const FittedModel& supplied, const FittedModel& extended,
                                   std::uint64_t seed);

}  // namespace towbench::harness::diagnose
