// The elastic error of a run that a camera watched, told axis by axis from log.csv and camera.csv.
// truth.csv is never opened.
#pragma once

#include <filesystem>
#include <vector>

#include "core/axis.h"
#include "study/identify/elastic_error.h"

namespace towbench::study {

struct WatchedAxis {
  core::Axis axis = core::Axis::kY;
  identify::ElasticError error;
};

// Throws FixtureError for a folder without the two files and for a damaged one.
[[nodiscard]] std::vector<WatchedAxis> read_watched_run(const std::filesystem::path& folder);

}  // namespace towbench::study
