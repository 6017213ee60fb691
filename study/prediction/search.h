// Which effects a model lacks: screened by score tests, fitted by prediction, chosen by
// cross-validation over blocks of time.
#pragma once

#include <functional>
#include <vector>

#include "study/prediction/acceptance.h"
#include "study/prediction/screening.h"

namespace towbench::study::diagnose {

// What predicts as well in a cause's place, fitted.
struct Alternative {
  const Effect* effect = nullptr;
  State state;
};

struct Cause {
  const Effect* effect = nullptr;
  bool sought = false;
  double p_value = 1;  // corrected for the number tried
  Comparison gain;     // its own, over the best model without it
  double power = 0;    // squares that it takes away, by their weights
  double share = 0;    // of those that the others leave beyond the encoder's steps
  std::vector<Alternative> alternatives = {};
};

struct Search {
  Context context;
  double bandwidth = 0;
  std::vector<Span> spans;
  State base;
  State final;
  std::vector<Cause> causes;
  std::vector<Candidate> refused;      // of the last round, best first
  std::vector<const Effect*> dropped;  // accepted, and too weak beside what is left
  std::size_t tried = 0;
  bool structured = false;  // much is left that no effect explains
};

// Asked once all that convinces is accepted, before it is revised: where false, the search ends.
using GoesOn = std::function<bool(const Search&)>;

[[nodiscard]] Search search_causes(const Data& data, const Context& context, const Model& start,
                                   const Limits& limits, const GoesOn& goes_on = {});

}  // namespace towbench::study::diagnose
