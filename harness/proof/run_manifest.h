// manifest.json: SHA-256, size and lines of every file of a run folder, inputs included, and a
// signature under the user's record key (record_key.h). Its format: harness/record/README.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace towbench::harness {

inline constexpr const char* kManifestFile = "manifest.json";

// Where a folder was recorded, as far as its signature shows.
enum class Origin : std::uint8_t {
  kHere,     // by this user on this machine, and not changed since
  kUnknown,  // without a key, or under another one: the hashes say that it is whole, not whose it
             // is
};

struct ManifestCheck {
  bool present = false;
  Origin origin = Origin::kUnknown;
  std::vector<std::string> problems;  // sentences; empty: the folder is what its manifest says
};

// The last step of a run. Throws std::filesystem::filesystem_error when it cannot be written.
void write_manifest(const std::filesystem::path& folder);

// Reads every file. A missing manifest is no problem of its own here; `present` says it.
[[nodiscard]] ManifestCheck check_manifest(const std::filesystem::path& folder);
// The same of some files only, named relative to the folder: no other is opened.
using FileChoice = std::function<bool(const std::string& name)>;
[[nodiscard]] ManifestCheck check_manifest(const std::filesystem::path& folder,
                                           const FileChoice& chosen);

[[nodiscard]] std::string_view sentence_for(Origin origin) noexcept;

}  // namespace towbench::harness
