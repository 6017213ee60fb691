// The same image on the same machine without the machine's faults: where the moments at which they
// begin are found, and what they are judged beside. It runs before them.
#pragma once

#include <cstdint>
#include <filesystem>

#include "harness/experiment/experiment_fixture.h"
#include "harness/fault_cases/case_record.h"
#include "harness/record/temporary_folder.h"

namespace towbench::harness {

class ReferenceBoard {
 public:
  // Runs. Throws FixtureError when the image cannot be loaded.
  ReferenceBoard(const ExperimentFixture& sound, const std::filesystem::path& image,
                 std::uint64_t seed);

  // Truth and events of the plant; rows and events of an image that tells them (debug_probe.h).
  [[nodiscard]] const CaseRecord& record() const noexcept { return record_; }
  // Its files, for those who judge and those who read.
  void copy_to(const std::filesystem::path& folder) const;

 private:
  TemporaryFolder files_;
  CaseRecord record_;
};

}  // namespace towbench::harness
