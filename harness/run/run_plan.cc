#include "harness/run/run_plan.h"

#include "harness/fixtures/canonical_hash.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/proof/sha256.h"
#include "harness/record/line_writer.h"
#include "harness/record/run_folder.h"
#include "harness/run/carrier_name.h"
#include "harness/run/driven_run.h"
#include "harness/run/run_carrier.h"

namespace towbench::harness {
namespace {

// A fault is judged beside a run of the same bits.
void refuse_faults_without_reference(const RunOptions& options) {
  const char* const why = "a fault is judged beside a reference run of the same bits";
  if (!options.encoder_lines.controller.empty()) {
    throw FixtureError({.file = "fault plan"}, "a run with its encoders on lines",
                       std::string("encoders over the carrier: ") + why);
  }
  if (options.clock == RunClock::kReal) {
    throw FixtureError({.file = "fault plan"}, "a run by the wall clock",
                       std::string("lockstep: ") + why);
  }
}

void plan_board(RunPlan& plan) {
  plan.kind = RunKind::kBoard;
  plan.board = std::make_unique<BoardRun>(plan.given, plan.options, plan.seed);
  plan.fixture = plan.board->fixture();
}

void plan_external(RunPlan& plan) {
  plan.kind = RunKind::kExternal;
  const auto& options = plan.options;
  if (!plan.given.experiment.faults.empty()) {
    refuse_faults_without_reference(options);
  }
  plan.external =
      std::make_unique<ExternalRun>(plan.given,
                                    ExternalPlay{.controller = *options.external,
                                                 .seed = plan.seed,
                                                 .watchers = options.watchers,
                                                 .by_wall_clock = options.clock == RunClock::kReal,
                                                 .tap = options.tap,
                                                 .run_operator = options.run_operator},
                                    options.reference);
  plan.fixture = plan.external->fixture();
}

void plan_faults(RunPlan& plan) {
  refuse_faults_without_reference(plan.options);
  plan.faults = std::make_unique<FaultedExperiment>(plan.given, plan.seed, kind_of(plan.options));
  plan.disturbance = Disturbance::kPlanned;
  plan.fixture = plan.faults->fixture();
}

// The image itself is an input: with it the folder replays.
ImageIdentity keep_image(const RunOptions& options, const std::filesystem::path& folder) {
  const auto name = options.firmware.filename();
  ImageIdentity image{.name = name.string()};
  if (options.keeps_image) {
    image.copy = std::filesystem::path("inputs") / name;
    std::filesystem::copy_file(options.firmware, folder / image.copy);
  }
  const auto digest = digest_of(options.firmware);
  image.bytes = digest.bytes;
  image.sha256 = digest.sha256;
  return image;
}

RunKind kind_without_board(const RunPlan& plan) {
  if (plan.has_faults() && plan.faults->kills_host()) {
    return RunKind::kKilledHost;
  }
  return plan.options.carrier == Carrier::kInProcess ? RunKind::kInProcess : RunKind::kChildProcess;
}

}  // namespace

RunPlan plan_run(const ExperimentFixture& fixture, const RunOptions& options) {
  RunPlan plan(fixture, options);
  plan.seed = options.seed.value_or(fixture.experiment.seed);
  if (options.external) {
    refuse_board_plan(fixture);
    plan_external(plan);
    return plan;
  }
  if (!fixture.experiment.reference.empty()) {
    throw FixtureError({fixture.file.string()}, "[[reference]]",
                       "--controller process:COMMAND or external:ADDRESS: BBMC has motions of its "
                       "own, which its console starts");
  }
  if (!options.firmware.empty()) {
    plan_board(plan);  // the machine's faults are the board's to make: machine_faults.h
    return plan;
  }
  if (!fixture.experiment.faults.empty()) {
    plan_faults(plan);
  } else if (options.run_operator != nullptr && options.clock == RunClock::kLockstep) {
    // By the wall clock an operator only types: there is nothing to disturb between the two.
    plan.disturbance = Disturbance::kByHand;
  }
  refuse_board_plan(fixture);
  plan.kind = kind_without_board(plan);
  if (options.clock == RunClock::kReal) {
    plan.realtime_budget = load_realtime_budget(plan.given.sources);
  }
  return plan;
}

void begin_record(RunPlan& plan) {
  const auto& options = plan.options;
  const auto& given = plan.given;
  plan.identity.carrier = name_of_carrier(options);
  plan.identity.clock = options.clock == RunClock::kReal ? "real" : "lockstep";
  plan.identity.fidelity = fidelity_of(options);
  plan.identity.seed = plan.seed;
  plan.identity.started_utc = utc_now();
  constexpr std::size_t kShortHash = 8;
  plan.folder = create_run_folder(options.out, given.experiment.name,
                                  hash_text(given.hash).substr(0, kShortHash));
  plan.identity.experiment_copy = copy_inputs(given.sources, plan.folder);
  if (!options.firmware.empty()) {
    plan.identity.image = keep_image(options, plan.folder);
  }
  write_started(plan.folder, given, plan.identity);
  if (options.tap != nullptr) {
    options.tap->begins(plan.folder);
  }
}

bool RunPlan::may_end_early() const noexcept {
  return has_faults() && faults->may_end_run();
}

void RunPlan::take_over(const InteractiveOperator& run_operator) {
  auto driven = as_driven(
      given, has_faults() ? faults->onsets_ns() : std::vector<core::Nanoseconds>{}, run_operator);
  if (driven.experiment.operator_acts.empty()) {
    return;
  }
  write_atomically(folder / identity.experiment_copy, driven.sources.front().text);
  if (external) {
    external->take_over(driven);
    fixture = external->fixture();
    return;
  }
  if (driven.experiment.faults.empty()) {
    fixture = std::move(driven);
    return;
  }
  faults = std::make_unique<FaultedExperiment>(driven, seed);
  disturbance = Disturbance::kPlanned;
  fixture = faults->fixture();
}

}  // namespace towbench::harness
