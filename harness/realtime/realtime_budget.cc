#include "harness/realtime/realtime_budget.h"

#include "harness/fixtures/fixture_paths.h"
#include "harness/fixtures/table_reader.h"

namespace towbench::harness {

RealtimeBudget read_realtime_budget(const FixtureFile& file) {
  RealtimeBudget budget;
  TableReader reader(file, file.table());
  std::string ignored;
  reader.text("name", ignored, "short name");
  reader.text("title", ignored, "one line for a person");
  reader.require("jitter");
  if (auto jitter = reader.subtable("jitter")) {
    jitter->value("p999_max_ratio", budget.jitter_p999_max_ratio, {0.0, 1.0, false},
                  "largest p99.9 - p50 over the control period");
    jitter->text("source", budget.source, "where the figure comes from");
    jitter->require("p999_max_ratio");
    jitter->require("source");
    jitter->finish();
  }
  reader.finish();
  return budget;
}

RealtimeBudget load_realtime_budget(SourceFiles& sources) {
  const auto file = FixtureFile::load(fixtures_directory() / "budgets" / "real-time.toml");
  remember(sources, file);
  return read_realtime_budget(file);
}

}  // namespace towbench::harness
