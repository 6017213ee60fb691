// The folder of one run: its name, the copies of its fixtures, its incomplete first result.json.
#pragma once

#include <filesystem>
#include <string>

#include "harness/fixtures/fixture_file.h"

namespace towbench::harness {

// Makes `parent`/<UTC>-<name>-<hash>/, never an existing one. Throws filesystem_error.
[[nodiscard]] std::filesystem::path create_run_folder(const std::filesystem::path& parent,
                                                      const std::string& name,
                                                      const std::string& short_hash);

// Copies every file below folder/inputs/, keeping where they lie relative to each other, and
// returns the path of the first one, relative to `folder`.
[[nodiscard]] std::filesystem::path copy_inputs(const SourceFiles& sources,
                                                const std::filesystem::path& folder);

// "2025-01-31T12:00:00Z" and, for a folder's name, "20250131T120000Z".
[[nodiscard]] std::string utc_now();
[[nodiscard]] std::string utc_now_compact();

}  // namespace towbench::harness
