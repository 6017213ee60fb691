#include <algorithm>

#include "harness/falsify/objective.h"
#include "harness/falsify/onset_phases.h"
#include "harness/falsify/rule_margin.h"
#include "harness/fault_cases/faulted_experiment.h"
#include "harness/record/temporary_folder.h"

namespace towbench::harness {
namespace {

class Candidate final : public Objective {
 public:
  Candidate(const ExperimentFixture& fixture, Asked asked, CandidateController controller)
      : fixture_(fixture), asked_(std::move(asked)), controller_(std::move(controller)) {
    auto& requirements = fixture_.experiment.requirements;
    requirements.clear();
    if (asked_.requirement) {
      requirements.push_back(*asked_.requirement);
      requirements.front().under_faults = true;
    }
    reference_ = reference_run_of(controller_, fixture_);
    if (!reference_->record.outcome.complete) {
      throw FixtureError({.file = fixture.file.string()}, reference_->record.outcome.reason,
                         "a controller whose run without faults comes to its end");
    }
  }

  Outcome measure(const SearchCase& one) override {
    try {
      if (one.setup.is_nominal()) {
        return run(one.faults, fixture_, reference_);
      }
      const TemporaryFolder folder;
      const auto fixture = in_setup(fixture_, one.setup, folder.path());
      const auto reference = reference_run_of(controller_, fixture);
      return reference->record.outcome.complete
                 ? run(one.faults, fixture, reference)
                 : Outcome{.reason = reference->record.outcome.reason};
    } catch (const FixtureError& error) {
      return {.reason = error.what()};
    }
  }

  double end_s() const override { return core::seconds(reference_->record.outcome.end_ns); }
  std::vector<Stretch> phases_of(const FaultChoice& choice) const override {
    return onset_phases(choice, reference_->record);
  }

 private:
  Outcome run(const FaultPlan& plan, const ExperimentFixture& fixture,
              const std::shared_ptr<const ReferenceRun>& reference) const {
    auto faulted = fixture;
    add_faults(faulted, plan);
    const TemporaryFolder folder;
    auto run = run_candidate(controller_, faulted, reference, folder.path());
    if (!run.complete) {
      return {.reason = std::move(run.reason)};
    }
    Outcome outcome{.fired = run.fired};
    auto& checks = run.checks;
    if (asked_.requirement) {
      std::erase_if(checks,
                    [&](const Check& check) { return check.name != asked_.requirement->id; });
      if (!checks.empty() && outcome.fired) {
        outcome.margin = checks.front().margin;
        outcome.broken = checks.front().verdict == Verdict::kFail;
        outcome.reason = checks.front().reason;
      }
    } else if (outcome.fired) {
      add_margin_of(checks, outcome);
    }
    return outcome;
  }

  ExperimentFixture fixture_;
  Asked asked_;
  CandidateController controller_;
  std::shared_ptr<const ReferenceRun> reference_;
};

}  // namespace

std::unique_ptr<Objective> candidate_objective(const ExperimentFixture& fixture, Asked asked,
                                               CandidateController controller) {
  return std::make_unique<Candidate>(fixture, std::move(asked), std::move(controller));
}

}  // namespace towbench::harness
