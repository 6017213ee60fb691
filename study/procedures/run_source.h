// Where the runs of a procedure come from, when not from memory: an emulator whose runs are kept,
// or a record.
#pragma once

#include <cstdint>

#include "harness/fixtures/controller_fixture.h"
#include "harness/fixtures/rig_fixture.h"
#include "harness/lockstep/script_loop.h"
#include "study/identify/recording.h"

namespace towbench::study::procedures {

// `experiment.name` is the conversation's, in words: what is done, unique in a procedure.
struct PlannedRun {
  const harness::RigFixture& rig;  // with the carriage where it starts
  const harness::ControllerFixture& controller;
  const harness::Experiment& experiment;
  std::uint64_t seed = 0;
};

class RunSource {
 public:
  RunSource() = default;
  RunSource(const RunSource&) = delete;
  RunSource& operator=(const RunSource&) = delete;
  virtual ~RunSource() = default;

  // Columns in one frame, positions as the controller's counts; what went wrong is their trouble.
  // `period_s` is 0 when it is the controller's.
  [[nodiscard]] virtual identify::Recording run(const PlannedRun& planned) = 0;
};

}  // namespace towbench::study::procedures
