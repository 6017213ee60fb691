// A case that was found, with what it does not need taken away.
#pragma once

#include "harness/falsify/objective.h"

namespace towbench::harness {

struct ShrunkCase {
  SearchCase needed{};
  Outcome outcome{};
  std::size_t runs = 0;
};

// Takes away one thing after the other, each for good where the margin stays within 2 % of
// `found`'s and what was broken stays broken: the machine's differences, each of them, the starts,
// the speed, the typed line, one fault of two.
[[nodiscard]] ShrunkCase shrink(const SearchCase& found, const Outcome& outcome,
                                Objective& objective);

}  // namespace towbench::harness
