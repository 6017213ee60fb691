// The log files of these tests, whole and damaged, and what is said of them.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "study/logs/finding.h"

namespace towbench::tests {

inline const std::filesystem::path kLogFiles = "tests/study/logs/data";

// Null when nothing of that name was found.
inline const study::logs::Finding* named(const study::logs::Findings& findings,
                                         std::string_view name) {
  const auto at = std::find_if(findings.begin(), findings.end(),
                               [&](const auto& finding) { return finding.name == name; });
  return at == findings.end() ? nullptr : &*at;
}

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// "plain.mat" as the name of a test: plain.
inline std::string stem_of(const char* file) {
  return std::filesystem::path(file).stem().string();
}

}  // namespace towbench::tests
