// One run of a search: where, and what came of it.
#pragma once

#include <cstddef>
#include <optional>

#include "harness/falsify/box_sampler.h"
#include "harness/falsify/objective.h"

namespace towbench::harness {

struct FalsifyTrial {
  std::size_t space = 0;
  BoxPoint point{};
  std::optional<SampleKind> sample{};  // none: chosen by the optimiser
  SearchCase tried{};
  Outcome outcome{};
};

}  // namespace towbench::harness
