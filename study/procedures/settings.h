// Reads a procedure's own file: name, title, and one table for each axis whose keys are those of
// the procedure's settings struct, by its visit().
#pragma once

#include <filesystem>
#include <string>

#include "core/axis.h"
#include "harness/fixtures/table_reader.h"

namespace towbench::study::procedures {

// Keys at the top hold for both axes, those of [axis.y] and [axis.x] over them. No file: defaults.
// Throws FixtureError.
template <typename Settings>
[[nodiscard]] Settings read_settings(const std::filesystem::path& path, core::Axis axis,
                                     Settings settings = {}) {
  if (path.empty()) {
    return settings;
  }
  const auto file = harness::FixtureFile::load(path);
  harness::TableReader reader(file, file.table());
  std::string ignored;
  reader.text("name", ignored, "the experiment's id");
  reader.text("title", ignored, "one line for a person");
  reader.text("description", ignored, "what it does");
  reader.group("settings", settings, "for both axes");
  if (auto axes = reader.subtable("axis")) {
    Settings other = settings;
    for (const auto which : core::kPlanarAxes) {
      axes->group(core::name_of(which), which == axis ? settings : other, "one axis");
    }
    axes->finish();
  }
  reader.finish();
  return settings;
}

}  // namespace towbench::study::procedures
