// A case of the campaign: a machine, what is hidden in it, and a plan that shows it; all from a
// seed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/diagnose/diagnosis.h"
#include "tests/study/diagnose/foreign/recording.h"
#include "tests/study/diagnose/foreign/visibility.h"

namespace towbench::tests::foreign {

enum class Scale {
  kPhysical,   // sizes that an analyst would notice
  kDetectable  // times what the logs could just detect: kFullTimes at strength 1
};
inline constexpr double kFullTimes = 5;

// What is asked for; what is empty is drawn.
struct Wish {
  std::string kind = "one";  // none, one, pair or outside
  std::string machine = {};
  std::string motion = {};  // of every run
  std::string effect = {};
  double strength = 1;
  Scale scale = Scale::kPhysical;
};

struct DrawnCase {
  std::uint64_t seed = 0;
  Machine machine;
  Plan plan;
  std::vector<Hidden> hidden;
  std::vector<Recording> runs;
  double visible = 0;  // times what could just be detected, of the weakest
  double share = 0;    // of the command, rms of what is lacking, of the weakest
  int redrawn = 0;     // draws that did not show what they hid, or were no measurement
};

// Throws std::runtime_error where no draw of a great many is fit.
[[nodiscard]] DrawnCase draw_case(const Wish& wish, std::uint64_t seed);
[[nodiscard]] study::diagnose::Request request_of(const DrawnCase& one);

}  // namespace towbench::tests::foreign
