#include "study/diagnose/cause_list.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "study/prediction/effect.h"

namespace towbench::study::diagnose {
namespace {

std::string entry(const Effect& effect) {
  std::vector<std::string> numbers = effect.amplitude_names;
  numbers.insert(numbers.end(), effect.scale_names.begin(), effect.scale_names.end());
  std::string out = fmt::format("{}: {}\n", effect.name, effect.cause);
  const auto line = [&](const char* what, const std::string& text) {
    out += fmt::format("  {:<10} {}\n", what, text);
  };
  line("law", effect.law);
  line("source", effect.source);
  line("numbers", fmt::format("{}", fmt::join(numbers, ", ")));
  line("needs", effect.needs);
  line("plant file", effect.plant_keys.empty()
                         ? "cannot express it"
                         : fmt::format("{}", fmt::join(effect.plant_keys, ", ")));
  return out;
}

}  // namespace

std::string cause_list() {
  std::vector<const Effect*> all;
  for (const Effect& effect : effects()) {
    if (effect.other <= 0) all.push_back(&effect);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Effect* a, const Effect* b) { return a->name < b->name; });
  std::string out =
      "Added to M a = u - B v - b - dry friction C: x place, v speed, a acceleration, u the input "
      "as a force.\n"
      "Beside them the fit moves M, B, C and b themselves. What another axis does is sought for "
      "each\n"
      "of up to " +
      std::to_string(kOthers) +
      " in the log: NAME for the first of the map, NAME_2 for the second.\n";
  for (const Effect* effect : all) out += "\n" + entry(*effect);
  return out;
}

}  // namespace towbench::study::diagnose
