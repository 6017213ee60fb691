// The forces that hidden effects put on the body, and what they do to command and encoder.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "core/random.h"

namespace towbench::tests {

// An effect that this generator hides. Within a family a log tells them apart least; a pair is
// drawn from two families.
struct HiddenEffectRow {
  std::string_view name;  // as study/prediction names it
  std::size_t family = 0;
  bool in_gate = true;  // one seed at full size is tried before every merge
};
[[nodiscard]] std::span<const HiddenEffectRow> hidden_effects();

struct BodyState {
  double t_s = 0;
  double x_m = 0;
  double v_m_per_s = 0;
  double a_m_per_s2 = 0;
  double since_reversal_m = 1;
  double drive_N = 0;
};

class HiddenForce {
 public:
  // Draws sign and phase.
  HiddenForce(std::string effect, double size, core::Random& random);

  // Resists the motion like the model's own friction: added to Coulomb friction, sign by motion.
  [[nodiscard]] double friction_N(const BodyState& s) const;
  // Pushes whatever the motion; positive towards max.
  [[nodiscard]] double force_N(const BodyState& s) const;
  [[nodiscard]] double extra_mass_kg() const;
  // What arrives of a commanded force.
  [[nodiscard]] double delivered_N(double command_N, const BodyState& s) const;
  [[nodiscard]] double delay_s() const;
  [[nodiscard]] double lag_s() const;
  // What the encoder reads for a position.
  [[nodiscard]] double read_m(double x_m) const;
  [[nodiscard]] bool is(const char* name) const { return effect_ == name; }
  [[nodiscard]] double size() const { return size_; }

 private:
  std::string effect_;
  double size_;
  double sign_;
  double phase_;  // in turns
};

}  // namespace towbench::tests
