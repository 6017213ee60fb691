// Whether a plan shows an effect at all, from the generator's own truth; no diagnosis is asked.
//
// The force that the file's law lacks is averaged over blocks of half a period of a band's highest
// frequency, while the axis moves, in what is fitted. The part that no parameter of the file can
// make is set against what encoder steps and torque noise leave of such a mean:
//   times = rms / max(kDetection noise / sqrt(blocks), least gain, least share of the command)
// in the best of several bands. An effect that lies in one column of the file's law counts by what
// the other columns cannot make; one that lies in several, as a whole: both against the file.
#pragma once

#include <vector>

#include "tests/study/diagnose/foreign/recording.h"

namespace towbench::tests::foreign {

inline constexpr double kVisible = 2;  // times what the logs could just detect

struct Visibility {
  double times = 0;
  double off = 0;        // of the force, share that the file's columns cannot make
  double force_N = 0;    // rms of the lacking force
  double command_N = 0;  // rms
  double moving = 0;     // share of the time
};

[[nodiscard]] Visibility visibility(const Machine& machine, const std::vector<Recording>& runs,
                                    Span span);
// Moves, and by no more than a machine has room for.
[[nodiscard]] bool is_sound(const Machine& machine, const std::vector<Recording>& runs);

}  // namespace towbench::tests::foreign
