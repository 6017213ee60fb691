// One experiment from fixture to judged run folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "harness/checks/check.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/external/external_controller.h"
#include "harness/fault_cases/fault_case.h"
#include "harness/fault_cases/reference_run.h"
#include "harness/judge/judge.h"
#include "harness/lockstep/operator.h"
#include "harness/lockstep/script_loop.h"
#include "harness/record/run_tap.h"
#include "protocol/carriers/carrier_address.h"

namespace towbench::harness {

enum class RunClock : std::uint8_t { kLockstep, kReal };
// kSerialPty: a serial line of its own between two processes, over pseudo-terminals.
enum class Carrier : std::uint8_t { kInProcess, kLocal, kWire, kSerialPty };

// Real lines of both sides; empty: they are messages. Need two processes.
struct LineEnds {
  std::string controller;
  std::string plant;
};

struct RunOptions {
  std::filesystem::path out = "runs";
  std::optional<std::uint64_t> seed;  // instead of the experiment's own
  Carrier carrier = Carrier::kInProcess;
  std::optional<protocol::CarrierEnds> wire;  // of Carrier::kWire
  LineEnds lines;                             // end-stops, kill switch, amplifiers: line_address.h
  LineEnds encoder_lines;                     // encoder_address.h
  // An ELF image that runs on the virtual board instead of the experiment's controller; empty:
  // none.
  std::filesystem::path firmware;
  bool keeps_image = true;  // in the run folder; otherwise its digest alone
  // Instead of the experiment's controller, for an experiment that states its reference itself.
  std::optional<ExternalController> external;
  // The run without faults that the faults of such a controller are judged beside, made before for
  // the same experiment, seed and controller; null: it is made here.
  std::shared_ptr<const ReferenceRun> reference;
  // Its UART is a terminal for a person, by the wall clock, instead of the experiment's console.
  bool person_at_console = false;
  RunClock clock = RunClock::kLockstep;              // kReal needs two processes: not kInProcess
  std::filesystem::path program = "/proc/self/exe";  // for the emulator's process
  LoopWatchers watchers;
  // Both may be null and outlive the run; not with `firmware`. What the operator did is in the
  // folder's copy of the experiment; it can break nothing in another process.
  InteractiveOperator* run_operator = nullptr;
  RunTap* tap = nullptr;
};

struct RunResult {
  std::filesystem::path folder;
  bool complete = false;
  std::string reason;  // why not
  RunOutcome outcome;
  std::string timing;                 // how the loops of a run in real time kept time, in words
  Judgement judgement;                // of a complete run
  std::optional<CaseVerdict> faults;  // of a complete run with faults
  int exit_code = kExitRuntime;
};

// Throws filesystem_error and system_error when the run cannot even begin, FixtureError for a fault
// that the carrier cannot have; after that every trouble
// is told in the result and in the folder.
[[nodiscard]] RunResult run_experiment(const ExperimentFixture& fixture, const RunOptions& options);

}  // namespace towbench::harness
