// Whole files that somebody else has written. A pipe, a device or a folder is refused without being
// opened for reading, and so is what is larger than it can be meant to be.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>

namespace towbench::harness {

// Why a file was not read, as half a sentence: "a pipe or a device".
struct Unreadable {
  std::string what;
};

[[nodiscard]] std::variant<std::string, Unreadable> read_regular_file(
    const std::filesystem::path& path, std::uint64_t largest_bytes);

}  // namespace towbench::harness
