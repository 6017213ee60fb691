// What was measured on a foreign machine: which motions, in which sessions, which of them held out,
// under which loop.
#pragma once

#include <string>
#include <vector>

#include "tests/study/diagnose/foreign/dice.h"
#include "tests/study/diagnose/foreign/machine.h"

namespace towbench::tests::foreign {

// What a session has of its own: nobody is asked to name it.
struct Session {
  double offset_N = 0;
  double friction = 1;  // times Coulomb
  double origin_m = 0;  // where the encoder was switched on
};

struct RunPlan {
  std::string motion;  // of motion_names()
  double duration_s = 0;
  bool held_out = false;
  std::size_t session = 0;
  double start_s = 0;  // of the session
  std::uint64_t seed = 0;
};

struct Loop {
  double bandwidth_Hz = 0;
  double damping = 0;
  double integral = 0;  // of the bandwidth
  double feedforward = 0;
};

struct Plan {
  std::vector<RunPlan> runs;
  std::vector<Session> sessions;
  Loop loop;
  bool with_reference = true;
  [[nodiscard]] bool has(const std::string& motion) const;
  [[nodiscard]] std::string words() const;  // one a run, "(h)" where it is held out
};

// hand: the drive lets go, and a hand moves the axis with a force that is logged in its place.
// pushed: laps, in which somebody leans on the load and nobody logs it.
[[nodiscard]] const std::vector<std::string>& motion_names();
// `motion`: of every run; empty: drawn for each.
[[nodiscard]] Plan draw_plan(const Machine& machine, const std::string& motion, Dice& dice);

}  // namespace towbench::tests::foreign
