// The controller's side in a process of its own, which a fault is to kill.
#pragma once

#include <functional>

namespace towbench::harness {

// Runs `side` in a child and returns when nobody holds its pipe any more: neither that process nor
// the plant that it has started, which has 5 s to notice. Says whether SIGKILL ended the child.
// Throws std::system_error.
[[nodiscard]] bool run_until_killed(const std::function<void()>& side);

}  // namespace towbench::harness
