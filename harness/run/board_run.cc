#include "harness/run/board_run.h"

#include <algorithm>

#include "harness/board_bench/firmware_run.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/judge/safety_checks.h"

namespace towbench::harness {
namespace {

constexpr const char* kReferenceFolder = "reference";

}  // namespace

BoardRun::BoardRun(const ExperimentFixture& fixture, const RunOptions& options, std::uint64_t seed)
    : options_(options), fixture_(fixture) {
  if (options.person_at_console) {
    fixture_.experiment.budgets_apply = false;  // they speak of the script
  }
  if (!fixture.experiment.faults.empty()) {
    refuse_faults_beyond(fixture.experiment.faults, FaultReach::kMachine);
    const auto sound = fixture_;
    reference_ =
        options.reference ? options.reference : run_reference_board(sound, options.firmware, seed);
    const auto prepared = prepare_without_bbmc(sound, reference_->record);
    if (const auto pressed = pressed_where_welded(sound, prepared)) {
      reference_ = run_reference_board(*pressed, options.firmware, seed);
    }
    fixture_ = with_faults(sound, prepared);
    for (const auto& left_out : each_left_out(sound, prepared, reference_->record)) {
      without_.push_back(
          {left_out.fault, run_reference_board(left_out.fixture, options.firmware, seed)});
    }
  }
}

RunOutcome BoardRun::play(const std::filesystem::path& folder, PlantEnd& plant, BoardTruth& truth) {
  const FirmwareOptions how{options_.firmware, options_.person_at_console};
  return run_firmware(fixture_, how, folder, {plant, truth}, options_.watchers, checks_);
}

void BoardRun::keep_reference(const std::filesystem::path& folder) const {
  if (reference_) {
    reference_->copy_to(folder / kReferenceFolder);
  }
}

void BoardRun::judge_into(const std::filesystem::path& folder, const RunOutcome& outcome,
                          Judgement& judgement) const {
  auto& checks = judgement.checks;
  const auto drop = [&](std::string_view name) {
    std::erase_if(checks, [&](const Check& check) { return check.name == name; });
  };
  const auto& faults = fixture_.experiment.board.faults;
  if (!faults.empty() && !options_.person_at_console) {
    drop("driven_by_hand");
  }
  for (auto& check : checks) {
    if (check.name == "driven_by_hand" && options_.person_at_console) {
      check.reason =
          "typed at the image's console; the run is recorded, does not replay, and "
          "proves nothing";
    }
  }
  const bool goes_dark = std::any_of(faults.begin(), faults.end(), [](const BoardFault& fault) {
    return fault.kind == BoardFault::Kind::kBrownOut;
  });
  if (goes_dark) {
    drop("log_complete");  // an image without a supply logs nothing
  }
  if (reference_ || (!faults.empty() && !fixture_.experiment.budgets_apply)) {
    drop("console_script");  // it speaks of the sound machine
  }
  if (reference_) {
    drop("edges_seen");  // a fault may keep every axis still; that the run without moves is judged
  }
  checks.insert(checks.begin(), checks_.begin(), checks_.end());
  if (reference_) {
    const auto beside = judge_beside_reference(folder, folder / kReferenceFolder, without_);
    checks.insert(checks.begin(), beside.begin(), beside.end());
  }
  SafetyScope image{
      .reference_is_known = false, .operator_types = true, .typed_s = {}, .restarts_s = {}};
  for (const auto restarted_ns : outcome.restarted_ns) {
    image.restarts_s.push_back(core::seconds(restarted_ns));
  }
  for (const auto typed_ns : outcome.typed_ns) {
    image.typed_s.push_back(core::seconds(typed_ns));
  }
  judge_safety(folder, limits_of(fixture_.rig.parameters), image, checks);
  judgement.verdict = worst_of(checks);
}

void refuse_board_plan(const ExperimentFixture& fixture) {
  if (!fixture.experiment.board.empty()) {
    throw FixtureError({.file = "experiment"}, "a [[board_fault]], [[board_budget]] or wiring",
                       "an image on the virtual board: --controller firmware:IMAGE.elf");
  }
}

}  // namespace towbench::harness
