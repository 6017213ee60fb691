// What the found model predicts better: on held-out runs, or cross-validated within the fitted
// ones.
//
// On held-out runs offset and level of dry friction are moved as far as the first quarter of each
// supports against what runs usually differ by (ridge), before and after alike; that quarter is not
// scored. What is scored decides one thing: causes that the held-out runs speak against are not
// named.
#pragma once

#include <vector>

#include "study/prediction/interval.h"
#include "study/prediction/search.h"

namespace towbench::study::diagnose {

struct Scored {
  double before_rms_N = 0;  // the stated structure refitted
  double after_rms_N = 0;
  double supplied_rms_N = 0;
  double force_rms_N = 0;
  Interval gain95;
  Interval gain99;
  Interval over_supplied95;
  bool same_session = true;
};

[[nodiscard]] Scored score_within(const Data& data, const Search& search);
[[nodiscard]] Scored score_on(const std::vector<Run>& holdout, const Data& fitted,
                              const Search& search);

}  // namespace towbench::study::diagnose
