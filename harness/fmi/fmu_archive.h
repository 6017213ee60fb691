// The ZIP archive of a Functional Mock-up Unit, written and unpacked by libzip.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace towbench::harness {

struct FmuEntry {
  std::string name;  // "binaries/x86_64-linux/model.so"
  std::string bytes;
};

// The same bytes for the same entries. Throws std::runtime_error.
void write_fmu(const std::filesystem::path& file, const std::vector<FmuEntry>& entries);

// Into an existing empty folder. Refused before anything is written: a name that is absolute, has
// ".." or a backslash, or stands twice; more than 10,000 entries, 256 MiB in all. Empty, or what is
// wrong in half a sentence.
[[nodiscard]] std::string unpack_fmu(const std::string& archive,
                                     const std::filesystem::path& folder);

}  // namespace towbench::harness
