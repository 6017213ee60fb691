// What a formula is read on: signals sampled at the same times, moments of events, and windows.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace towbench::harness {

struct TraceWindow {
  double from_s = 0;  // both ends belong to it
  double to_s = 0;
};

struct Trace {
  std::vector<double> time_s{};  // rising
  // In the order of the vocabulary; NaN where a signal has no value. A signal that the record lacks
  // altogether is empty.
  std::vector<std::vector<double>> signals{};
  std::map<std::string, std::vector<double>> events{};  // times, rising
  std::map<std::string, TraceWindow> windows{};

  [[nodiscard]] std::size_t samples() const noexcept { return time_s.size(); }
};

}  // namespace towbench::harness
