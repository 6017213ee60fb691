// What a page may ask of the bench, one JSON object a message: {"do": "pause"}, ...
#pragma once

#include <string>
#include <string_view>

#include "harness/panel/session.h"

namespace towbench::harness {

// Carries it out. Empty, or a sentence for the person who asked: not understood, out of range, not
// possible now. Never throws.
//
//   start {experiment, lines: [[index, text]...], faults: [words...], seed, duration_limit_s,
//          clock: "lockstep" | "real", speed, paused, hold} | cut | finish | pause | resume | step
//          {ms} | speed {speed} | type {text}
//   break {fault: "PART KIND [parameters]"} | clear {fault: "PART KIND"}
[[nodiscard]] std::string steer(Session& session, std::string_view message) noexcept;

}  // namespace towbench::harness
