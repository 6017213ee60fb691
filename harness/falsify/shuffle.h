// In a drawn order, the same with every library.
#pragma once

#include <utility>
#include <vector>

#include "core/random.h"

namespace towbench::harness {

template <typename Element>
void shuffle(std::vector<Element>& all, core::Random& random) {
  for (auto i = all.size(); i > 1; --i) {
    std::swap(all[i - 1], all[random.bits() % i]);
  }
}

}  // namespace towbench::harness
