// Tows that were made before, as the runs of a procedure: nothing is emulated.
#pragma once

#include <optional>
#include <string>

#include "study/procedures/run_source.h"
#include "study/runs/foreign_log.h"

namespace towbench::study {

class RecordedRuns final : public procedures::RunSource {
 public:
  // The runs of experiment `id`; `list` outlives this. Throws FixtureError for columns that cannot
  // be used.
  RecordedRuns(std::string id, const TowList& list);

  // Throws FixtureError or CsvError for a record that cannot be read. A run that is not listed is
  // the recording's trouble.
  [[nodiscard]] identify::Recording run(const procedures::PlannedRun& planned) override;

 private:
  std::string id_;
  const TowList& list_;
  std::optional<LogColumns> columns_;
};

}  // namespace towbench::study
