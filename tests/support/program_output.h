// What a program printed and how it ended, as a shell runs it.
#pragma once

#include <array>
#include <cstdio>
#include <string>

#include <sys/wait.h>

namespace towbench::tests {

struct ProgramOutput {
  int code = -1;
  std::string text;  // stdout and stderr
};

// A path as one word of a shell's command, also within single quotes.
inline std::string quoted(const std::string& path) {
  return '"' + path + '"';
}

inline ProgramOutput output_of(const std::string& command) {
  ProgramOutput output;
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> bytes{};
  for (std::size_t count = 0; (count = fread(bytes.data(), 1, bytes.size(), pipe)) > 0;) {
    output.text.append(bytes.data(), count);
  }
  output.code = WEXITSTATUS(pclose(pipe));
  return output;
}

}  // namespace towbench::tests
