// How far an experiment that estimates is: one line on a terminal, gone when the next thing is
// told.
#pragma once

#include <cstdio>
#include <string>

#include <unistd.h>

namespace towbench::harness {

class StudyProgress {
 public:
  explicit StudyProgress(bool wanted) : wanted_(wanted && isatty(STDERR_FILENO) == 1) {}
  StudyProgress(const StudyProgress&) = delete;
  StudyProgress& operator=(const StudyProgress&) = delete;
  ~StudyProgress() { clear(); }

  void show(const std::string& what, double share) {
    if (wanted_) {
      std::fprintf(stderr, "\r%s: %.0f %%\033[K", what.c_str(), 100 * share);
      std::fflush(stderr);
      shown_ = true;
    }
  }
  void clear() {
    if (shown_) {
      std::fputs("\r\033[K", stderr);
      shown_ = false;
    }
  }

 private:
  bool wanted_;
  bool shown_ = false;
};

}  // namespace towbench::harness
