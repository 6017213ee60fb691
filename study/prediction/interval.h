// A value with the limits that it lies between.
#pragma once

namespace towbench::study::diagnose {

struct Interval {
  double value = 0;
  double low = 0;
  double high = 0;
};

}  // namespace towbench::study::diagnose
