#include "study/runs/tow_list.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/fixtures/table_reader.h"
#include "harness/fixtures/toml_string.h"

namespace towbench::study {
namespace {

ListedTow read_tow(harness::TableReader& reader, bool has_columns) {
  ListedTow tow;
  reader.text("experiment", tow.experiment, "id of the tow experiment");
  reader.text("name", tow.name, "name of the run in that experiment");
  reader.text("folder", tow.folder, "a run folder");
  reader.text("log", tow.log, "a CSV, instead of a run folder");
  reader.text("force", tow.force, "a CSV of the force, when the log holds none");
  reader.list("steady_from_s", tow.steady_from_s, core::at_least(0.0), "where the speed is steady");
  reader.list("steady_to_s", tow.steady_to_s, core::at_least(0.0), "where that ends");
  reader.require("experiment");
  reader.require("name");
  reader.finish();
  if (tow.folder.empty() == tow.log.empty()) {
    throw harness::FixtureError(reader.place_of(tow.log.empty() ? "name" : "log"),
                                tow.log.empty() ? "neither folder nor log" : "folder and log",
                                "folder = \"RUN FOLDER\" or log = \"FILE.csv\"");
  }
  if (!tow.log.empty() && !has_columns) {
    throw harness::FixtureError(reader.place_of("log"), "a log without columns",
                                "columns = \"FILE.toml\" at the top: which column is what");
  }
  if (tow.steady_from_s.size() != tow.steady_to_s.size()) {
    throw harness::FixtureError(
        reader.place_of("steady_to_s"),
        fmt::format("{} ends of {} beginnings", tow.steady_to_s.size(), tow.steady_from_s.size()),
        "an end for each beginning");
  }
  return tow;
}

}  // namespace

TowList read_tow_list(const std::filesystem::path& folder) {
  TowList list{.file = folder / kTowListFile, .columns = {}, .tows = {}};
  const auto file = harness::FixtureFile::load(list.file);
  harness::TableReader reader(file, file.table());
  std::string ignored;
  reader.text("title", ignored, "one line for a person");
  reader.text("columns", list.columns, "file that names the logs' columns");
  for (auto& each : reader.tables("tow")) {
    auto tow = read_tow(each, !list.columns.empty());
    const bool twice = std::any_of(list.tows.begin(), list.tows.end(), [&](const auto& other) {
      return other.experiment == tow.experiment && other.name == tow.name;
    });
    if (twice) {
      throw harness::FixtureError(each.place_of("name"), '"' + tow.name + '"',
                                  "each run of an experiment once");
    }
    list.tows.push_back(std::move(tow));
  }
  reader.finish();
  if (list.tows.empty()) {
    throw harness::FixtureError({.file = list.file.string()}, "no [[tow]]",
                                "one for each recorded run");
  }
  return list;
}

std::string tow_list_toml(const std::vector<ListedTow>& tows) {
  std::string text = "schema = 1\n";
  for (const auto& tow : tows) {
    text += fmt::format("\n[[tow]]\nexperiment = {}\nname = {}\nfolder = {}\n",
                        harness::toml_string(tow.experiment), harness::toml_string(tow.name),
                        harness::toml_string(tow.folder));
  }
  return text;
}

}  // namespace towbench::study
