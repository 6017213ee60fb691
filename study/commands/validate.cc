// towbench validate where settings of experiments that estimate are among the files.
#include "harness/commands/validate.h"

#include <string>

#include <CLI/CLI.hpp>

#include "harness/fixtures/fixture_error.h"
#include "study/commands/verbs.h"
#include "study/procedures/procedure.h"
#include "study/procedures/tow/tow_procedure.h"

namespace towbench::study {
namespace {

// True when one of `all` is the experiment that the file's name says; it has read the file then.
template <typename Procedures>
bool one_reads(const Procedures& all, const std::filesystem::path& path, std::string& ids) {
  for (const auto& each : all) {
    if (each->id() == path.stem().string()) {
      each->check_settings(path);
      return true;
    }
    ids += (ids.empty() ? "" : ", ") + std::string(each->id());
  }
  return false;
}

void read_settings_file(const std::filesystem::path& path) {
  std::string ids;
  if (!one_reads(procedures::identification_procedures(), path, ids) &&
      !one_reads(procedures::tow_procedures(), path, ids)) {
    throw harness::FixtureError({path.string(), 0, "file name"}, path.stem().string(), ids);
  }
}

}  // namespace

void add_validate_all(CLI::App& app, int& exit_code) {
  harness::add_validate_verb(app, exit_code, [](const std::vector<std::string>& named) {
    return harness::validate_each(harness::fixtures_named(named), read_settings_file);
  });
}

}  // namespace towbench::study
