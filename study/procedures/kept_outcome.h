// What an interrupted set left, and whether it may be used again.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

namespace towbench::study::procedures {

// Sixteen hex digits of this very program: what another build found is not taken for its own.
[[nodiscard]] const std::string& program_fingerprint();
// Of a file's text; of an empty path or a file that is not there, of nothing.
[[nodiscard]] std::string file_fingerprint(const std::filesystem::path& path);

// What was kept under that fingerprint; none when there is nothing, or it is torn or another's.
[[nodiscard]] std::optional<nlohmann::json> kept_outcome(const std::filesystem::path& path,
                                                         const std::string& fingerprint);
// Throws std::runtime_error for a folder that cannot be written.
void keep_outcome(const std::filesystem::path& path, const std::string& fingerprint,
                  const nlohmann::json& outcome);

}  // namespace towbench::study::procedures
