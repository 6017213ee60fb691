// One line on the terminal that says how far a long run is: only on a terminal, only after two
// seconds, gone when done.
#pragma once

#include <chrono>
#include <string>

#include "core/time.h"

namespace towbench::harness {

class ProgressLine {
 public:
  ProgressLine(std::string name, double limit_s, bool wanted);
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();

  void show(core::Nanoseconds virtual_time_ns);

 private:
  using Clock = std::chrono::steady_clock;
  std::string name_;
  double limit_s_;
  bool wanted_;
  bool shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

}  // namespace towbench::harness
