// This program and whatever else its terminal runs, ahead of what other sessions run.
//
// Where the kernel groups by session (sched(7), autogroup: Debian's does) it shares a processor out
// among sessions first, a half each, and only then among the threads of one. A browser is a session
// of its own: against it a thread's nice value (turns.h) has no effect at all.
#pragma once

#include <filesystem>
#include <optional>

namespace towbench::harness {

class AheadOfOtherSessions {
 public:
  // Nothing is changed where there are no such groups, where this one is that far ahead already, or
  // where the host does not allow it. `file`: the kernel's, of this process.
  explicit AheadOfOtherSessions(std::filesystem::path file = "/proc/self/autogroup");
  AheadOfOtherSessions(const AheadOfOtherSessions&) = delete;
  AheadOfOtherSessions& operator=(const AheadOfOtherSessions&) = delete;
  // As it was before. Who is killed (SIGKILL) leaves it ahead, for what else its terminal runs.
  ~AheadOfOtherSessions();

 private:
  std::filesystem::path file_;
  std::optional<int> before_;  // of what was changed
};

}  // namespace towbench::harness
