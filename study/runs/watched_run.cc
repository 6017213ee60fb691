#include "study/runs/watched_run.h"

#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "harness/checks/sensor_files.h"
#include "harness/files/csv_table.h"
#include "harness/fixtures/fixture_error.h"

namespace towbench::study {
namespace {

std::vector<double> copied(std::span<const double> column) {
  return {column.begin(), column.end()};
}

identify::ElasticInput input_of(const harness::CsvTable& log, const harness::CsvTable& camera,
                                core::Axis axis) {
  const auto of_axis = [&](const char* name) {
    return copied(log.required(fmt::format("{}_{}", core::name_of(axis), name), "log.csv"));
  };
  return {.time_s = copied(log.required("time_s", "log.csv")),
          .motor_m = of_axis("position_m"),
          .speed_m_per_s = of_axis("reference_velocity_m_per_s"),
          .frame_s = copied(camera.required("time_s", harness::kCameraFile)),
          .seen_m = copied(camera.required(harness::camera_column(axis), harness::kCameraFile))};
}

void refuse_unwatched(const std::filesystem::path& folder) {
  for (const auto file : {std::string_view("log.csv"), harness::kCameraFile}) {
    if (!std::filesystem::exists(folder / file)) {
      throw harness::FixtureError({.file = (folder / file).string()}, "no such file",
                                  "the folder of a run whose rig has camera.fitted = true");
    }
  }
}

}  // namespace

std::vector<WatchedAxis> read_watched_run(const std::filesystem::path& folder) try {
  refuse_unwatched(folder);
  const auto log = harness::CsvTable::load(folder / "log.csv");
  const auto camera = harness::CsvTable::load(folder / harness::kCameraFile);
  std::vector<WatchedAxis> axes;
  for (const auto axis : core::kPlanarAxes) {
    if (camera.has(harness::camera_column(axis))) {
      axes.push_back({axis, identify::elastic_error(input_of(log, camera, axis))});
    }
  }
  return axes;
} catch (const harness::CsvError& error) {
  throw harness::FixtureError({.file = folder.string()}, error.what(),
                              "log.csv and camera.csv of a run");
}

}  // namespace towbench::study
