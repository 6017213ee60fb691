// What is odd about the data itself, told by name before any model is blamed.
#pragma once

#include <string>
#include <vector>

namespace towbench::study::logs {

struct Finding {
  enum class Kind { kNote, kFatal };
  Kind kind = Kind::kNote;
  std::string name;      // snake_case, part of the interface
  std::string sentence;  // what was seen, and what to do
};

using Findings = std::vector<Finding>;

[[nodiscard]] inline bool is_fatal(const Findings& findings) noexcept {
  for (const Finding& finding : findings) {
    if (finding.kind == Finding::Kind::kFatal) {
      return true;
    }
  }
  return false;
}

}  // namespace towbench::study::logs
