// A word as a POSIX shell reads it back unchanged.
#pragma once

#include <string>

namespace towbench::harness {

// In single quotes, inside which nothing means anything.
[[nodiscard]] inline std::string shell_quoted(const std::string& word) {
  std::string text = "'";
  for (const char letter : word) {
    text += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  }
  return text + "'";
}

}  // namespace towbench::harness
