// Where a case comes from: the foreign machines, the tests' rigid axis, or the bench itself.
#pragma once

#include <string>
#include <vector>

#include "tests/study/diagnose/foreign/drawn_case.h"
#include "tests/study/diagnose/foreign/score.h"

namespace towbench::tests::foreign {

// A case with what it is called in the tables.
struct Posed {
  std::vector<Key> hidden;
  bool is_outside = false;
  std::string machine;
  std::string plan;
  std::vector<std::string> motions;  // those of the plan, each once
  std::size_t sessions = 1;
  double rate_Hz = 0;
  double resolution_m = 0;
  double visible = 0;
  double share = 0;
  int redrawn = 0;
  study::diagnose::Request request;
};

// foreign, hidden_axis, bench. Throws std::runtime_error where it has no such case.
[[nodiscard]] Posed pose(const std::string& generator, const Wish& wish, std::uint64_t seed);
[[nodiscard]] Posed pose(const Wish& wish, const DrawnCase& drawn);

}  // namespace towbench::tests::foreign
