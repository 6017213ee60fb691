// One line on the terminal that says how far a long verb is: only on a terminal, gone when done.
#pragma once

#include <chrono>
#include <functional>
#include <string>

namespace towbench::harness {

class ProgressLine {
 public:
  explicit ProgressLine(bool wanted);
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() { clear(); }

  void show(const std::string& text);
  void show(const std::string& what, double share);  // 0 to 1
  // For a loop that calls often: from two seconds on, at most five times a second; `text` is made
  // only then.
  void show_sometimes(const std::function<std::string()>& text);
  void clear();
  // Since the line was made.
  [[nodiscard]] double elapsed_s() const;

 private:
  using Clock = std::chrono::steady_clock;
  bool wanted_;
  bool shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

}  // namespace towbench::harness
