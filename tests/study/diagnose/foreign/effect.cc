#include "tests/study/diagnose/foreign/effect.h"

#include <iterator>

namespace towbench::tests::foreign {

const std::vector<Effect>& effects() {
  static const std::vector<Effect> kAll = [] {
    std::vector<Effect> all;
    for (auto& family : {friction_effects(), drive_effects(), place_effects(), body_effects(),
                         outside_effects()}) {
      all.insert(all.end(), family.begin(), family.end());
    }
    return all;
  }();
  return kAll;
}

const Effect* find(const std::string& name) {
  for (const Effect& effect : effects()) {
    if (effect.name == name) {
      return &effect;
    }
  }
  return nullptr;
}

Hidden draw_hidden(const std::string& name, double strength, Dice& dice) {
  Hidden hidden;
  hidden.name = name;
  hidden.strength = strength;
  hidden.draw = dice.uniform();
  hidden.place = dice.uniform();
  hidden.sign = dice.sign();
  return hidden;
}

}  // namespace towbench::tests::foreign
