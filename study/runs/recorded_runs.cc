#include "study/runs/recorded_runs.h"

#include <algorithm>

#include <fmt/format.h>

#include "study/runs/run_columns.h"

namespace towbench::study {

RecordedRuns::RecordedRuns(std::string id, const TowList& list) : id_(std::move(id)), list_(list) {
  if (!list.columns.empty()) {
    columns_ = read_log_columns(list.file.parent_path() / list.columns);
  }
}

identify::Recording RecordedRuns::run(const procedures::PlannedRun& planned) {
  const auto& name = planned.experiment.name;
  const auto found = std::find_if(list_.tows.begin(), list_.tows.end(), [&](const auto& tow) {
    return tow.experiment == id_ && tow.name == name;
  });
  if (found == list_.tows.end()) {
    identify::Recording nothing;
    nothing.trouble = fmt::format("{} lists no tow \"{}\" of {}", list_.file.string(), name, id_);
    return nothing;
  }
  const auto folder = list_.file.parent_path();
  return found->folder.empty() ? read_foreign_log(*found, *columns_, folder, planned.rig.parameters)
                               : read_run_columns(folder / found->folder);
}

}  // namespace towbench::study
