// BBMC set up from an identification: what it believes of the machine is what was estimated.
#pragma once

#include <string>

#include "harness/fixtures/controller_text.h"
#include "study/identify/estimate.h"
#include "study/procedures/machine.h"

namespace towbench::study::procedures {

struct SetUpController {
  bbmc::Configuration configuration;
  harness::SourcesByKey sources;  // of the values that were estimated
};

// `before` with every belief replaced that an estimate speaks of; what nothing was found of stays.
//
//   drive                K_T, K_amp
//   gains                times identified over believed inertia: the same poles of the rigid axis
//   feed_forward         J, B, and C as the mean over the places at which it was found
//   friction             the same C and B, S = C + the excess of break-away, Stribeck speed
//   braking              J, the rotor's part, the swing with a held motor
//   disturbance_observer the rotor's part; limit of twice S
//   lead, homing         the carriage's share of S; homing: of S at the ends of the track
//   plausibility         S at the place of most friction, and the part of it that the interval adds
//   ends                 the max switch by its distance from the min switch; what lies around it
//                        keeps its distance to it
//   speed_limit          the saturation speed
//
// Shares, rotor: where none was found, what documents or `before` say.
[[nodiscard]] SetUpController set_up_controller(const bbmc::Configuration& before,
                                                const Machine& machine,
                                                const identify::Estimates& estimates);

// The same as a controller fixture; empty when nothing was estimated.
[[nodiscard]] std::string identified_controller(const Machine& machine,
                                                const identify::Estimates& estimates);

}  // namespace towbench::study::procedures
