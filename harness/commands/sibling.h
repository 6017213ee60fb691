// The programs that lie beside this one.
#pragma once

#include <string>
#include <vector>

namespace towbench::harness {

// Replaces this process by `verb` of the program `sibling`; returns only when that cannot be
// started, with the exit code, and has said so.
[[nodiscard]] int hand_over(const std::string& sibling, const std::string& verb,
                            const std::vector<std::string>& rest);

}  // namespace towbench::harness
