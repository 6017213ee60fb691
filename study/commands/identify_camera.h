// towbench identify --camera: how far the carriage is behind its motor, from the encoder and the
// camera of one run. The truth is not opened.
#pragma once

#include <filesystem>

namespace towbench::study {

// Prints a table, or JSON. Exit code: 0 told for an axis that moved, 4 for none. Throws
// FixtureError for a folder without log.csv or camera.csv, and for a damaged one.
int tell_elastic_error(const std::filesystem::path& run_folder, bool json);

}  // namespace towbench::study
