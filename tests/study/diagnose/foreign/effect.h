// What can be wrong in a foreign machine: laws of textbooks, each with the names that are a right
// answer. Sizes are those that an analyst would notice by eye; `strength` multiplies them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/study/diagnose/foreign/machine.h"

namespace towbench::tests::foreign {

// An effect with its size drawn.
struct Hidden {
  std::string name;
  double strength = 1;  // times the size that is drawn
  double draw = 0.5;    // where in its range the size lies, 0 to 1
  double place = 0;     // a second draw of the same kind: a phase, a width
  double sign = 1;
};

// A body at an instant, as laws see it.
struct Now {
  double t_s = 0;  // since the session began
  double h_s = 0;  // of the step
  double x_m = 0;
  double v_m_per_s = 0;
  double a_m_per_s2 = 0;
  double drive_N = 0;
};

using Force = std::function<double(const Now&)>;

// What the effect changes; what is empty or zero changes nothing.
struct Law {
  Force dry_N = {};  // added to the dry friction of the whole axis, at the body's place and speed
  Force on_motor_N = {};  // positive pushes towards positive positions
  Force on_load_N = {};   // the same at the load
  Force memory_N = {};    // a force with a state: called once a step, at the motor
  std::function<double(double command_N, const Now&)> delivered_N = {};
  std::function<double(double x_m)> reading_m = {};
  double breakaway_N = 0;   // more to leave rest than to stay in motion
  double presliding_m = 0;  // dry friction builds up over this way (Dahl 1968)
  double dead_time_s = 0;
  double lag_s = 0;
  double added_kg = 0;
  double coulomb_N = 0;
  double viscous_N_s_per_m = 0;
  double chain_Hz = 0;  // two bodies where the file states one; or another stiffness than stated
  double play_m = 0;
  double gravity_unstated = 0;  // share of a joint's gravity that the file leaves out
};

// What of the file's own structure an effect is part of.
enum class Span { kNone, kMass, kViscous, kCoulomb, kBias, kSeveral };

struct Effect {
  std::string name;
  std::string family;               // a pair is of two families
  std::vector<std::string> right;   // answers that the physics calls the same
  std::vector<std::string> beside;  // parameters that its shape may move: neither right nor wrong
  Span span = Span::kNone;
  std::function<bool(const Machine&)> fits;
  std::function<Law(const Hidden&, const Machine&)> law;
  bool by_name = false;  // drawn only where it is asked for
};

// Of the library's names, and those of no library (family "outside").
[[nodiscard]] const std::vector<Effect>& effects();
[[nodiscard]] const Effect* find(const std::string& name);
[[nodiscard]] Hidden draw_hidden(const std::string& name, double strength, Dice& dice);

// A size between two ends, by the draw.
[[nodiscard]] inline double sized(const Hidden& hidden, double low, double high) {
  return hidden.strength * (low + (high - low) * hidden.draw);
}

inline bool any_machine(const Machine& /*machine*/) {
  return true;
}
// One body by its file.
inline bool rigid(const Machine& machine) {
  return machine.chain_Hz == 0;
}

[[nodiscard]] std::vector<Effect> friction_effects();
[[nodiscard]] std::vector<Effect> drive_effects();
[[nodiscard]] std::vector<Effect> place_effects();
[[nodiscard]] std::vector<Effect> body_effects();
[[nodiscard]] std::vector<Effect> outside_effects();

}  // namespace towbench::tests::foreign
