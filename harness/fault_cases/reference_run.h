// A run without the faults, of a controller that is not BBMC: where the moments at which they begin
// are found, and what they are judged beside. It runs before them.
#pragma once

#include <filesystem>

#include "harness/fault_cases/case_record.h"
#include "harness/record/temporary_folder.h"

namespace towbench::harness {

struct ReferenceRun {
  TemporaryFolder files;  // as in a run folder
  CaseRecord record;      // truth and events of the plant, and what is known of the controller

  void copy_to(const std::filesystem::path& folder) const {
    std::filesystem::copy(files.path(), folder, std::filesystem::copy_options::recursive);
  }
};

}  // namespace towbench::harness
