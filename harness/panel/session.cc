#include "harness/panel/session.h"

#include <exception>

#include <fmt/format.h>
#include <sys/mman.h>

#include "harness/experiment/experiment_toml.h"
#include "harness/fault_cases/faulted_experiment.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/fixtures/canonical_hash.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/panel/autogroup.h"
#include "harness/panel/live_operator.h"
#include "harness/panel/realtime_operator.h"
#include "harness/panel/shown_configuration.h"
#include "harness/panel/turns.h"
#include "harness/report/report.h"

namespace towbench::harness {
namespace {

constexpr double kLongestRun_s = 86'400.0;

// What the panel changed is the experiment's text from now on: the folder's copy replays it.
void change(ExperimentFixture& fixture, const SessionStart& wanted) {
  auto& experiment = fixture.experiment;
  bool changed = false;
  for (const auto& [index, line] : wanted.lines) {
    if (index >= experiment.console.size()) {
      throw FixtureError({.file = "panel", .key = "lines"}, std::to_string(index),
                         fmt::format("a line below {}", experiment.console.size()));
    }
    changed = changed || experiment.console[index].send != line;
    experiment.console[index].send = line;
  }
  // Budgets are of the experiment as its file has it.
  experiment.budgets_apply = experiment.budgets_apply && !changed;
  if (wanted.duration_limit_s) {
    if (!(*wanted.duration_limit_s > 0 && *wanted.duration_limit_s <= kLongestRun_s)) {
      throw FixtureError({.file = "panel", .key = "duration_limit_s"},
                         fmt::format("{}", *wanted.duration_limit_s), "0 < x <= 86400");
    }
    experiment.duration_limit_s = *wanted.duration_limit_s;
  }
  experiment.operator_acts = {{.text = "by hand"}};
  if (changed) {
    experiment.operator_acts.push_back(
        {.kind = OperatorAct::Kind::kChanged, .text = "lines of the script"});
  }
  if (wanted.holds) {
    experiment.operator_acts.push_back(
        {.kind = OperatorAct::Kind::kHolds, .text = "goes on after its script"});
  }
  fixture.sources.front().text = to_toml(fixture);
  CanonicalHash hash;
  hash.add(fixture.sources.front().text);
  fixture.hash = hash.value();
}

// By the wall clock: what `change` had no reason to refuse.
void refuse_unless_bearable(const SessionStart& wanted, const FaultPlan& faults) {
  if (wanted.clock != RunClock::kReal) {
    return;
  }
  if (!faults.empty()) {
    throw FixtureError({.file = "panel", .key = "faults"}, "a run by the wall clock",
                       "lockstep: a fault is judged beside a reference run of the same bits");
  }
  if (wanted.pace.paused || wanted.pace.speed != 1) {
    throw FixtureError({.file = "panel", .key = "speed"}, "a run by the wall clock",
                       "real time, not paused");
  }
}

std::string first_trouble(const Judgement& judgement) {
  for (const auto& check : judgement.checks) {
    if (check.verdict != Verdict::kPass) {
      return check.name + (check.reason.empty() ? "" : ": " + check.reason);
    }
  }
  return {};
}

}  // namespace

void Session::start(const SessionStart& wanted) {
  if (const auto phase = state().phase; phase == Phase::kRunning || phase == Phase::kJudging) {
    throw FixtureError({.file = "panel"}, "a second run", "one at a time: finish the first");
  }
  auto fixture =
      std::make_unique<ExperimentFixture>(load_experiment(find_experiment(wanted.experiment)));
  if (!fixture->experiment.reference.empty() && !controller_) {
    throw FixtureError({.file = "panel", .key = "experiment"}, '"' + wanted.experiment + '"',
                       "one of BBMC's; who follows a [[reference]] is named when the panel starts: "
                       "--controller process:COMMAND");
  }
  FaultPlan plan;
  for (const auto& words : wanted.faults) {
    plan.push_back(parse_fault(words));
  }
  refuse_unless_bearable(wanted, plan);
  add_faults(*fixture, plan);
  change(*fixture, wanted);
  const auto seed = wanted.seed.value_or(fixture->experiment.seed);
  cut_short();  // joins the thread of the last one
  operator_.reset();
  fixture_ = std::move(fixture);
  const auto& controller = fixture_->controller.configuration;
  const bool real = wanted.clock == RunClock::kReal;
  tap_.clear(bbmc::exchange_period_ns(controller.control_period_ns()),
             real ? LiveTap::Histogram::kOffPeriod : LiveTap::Histogram::kTook,
             fixture_->rig.parameters.force_sensor.fitted,
             emulator::has_further_axes(fixture_->rig.parameters));
  stop_ = false;
  if (real) {
    operator_ =
        std::make_unique<RealtimeOperator>(fixture_->experiment.operator_acts, wanted.holds);
  } else {
    operator_ = std::make_unique<LiveOperator>(*fixture_, seed, wanted.pace, wanted.holds, stop_);
  }
  {
    const std::lock_guard lock(mutex_);
    state_ = {.phase = Phase::kRunning,
              .number = state_.number + 1,
              .name = fixture_->experiment.name,
              .title = fixture_->experiment.title,
              .clock = wanted.clock};
  }
  thread_ = std::thread([this, seed] { run(seed); });
}

RunResult Session::run_by_its_clock(std::uint64_t seed) {
  const AheadOfOtherSessions ahead;
  RunOptions options;
  options.out = runs_;
  options.seed = seed;
  options.run_operator = operator_.get();
  options.tap = &tap_;
  options.watchers.stop = &stop_;
  options.clock = state().clock;
  if (!fixture_->experiment.reference.empty()) {
    options.external = controller_;
  }
  if (options.clock == RunClock::kLockstep) {
    return run_experiment(*fixture_, options);
  }
  options.carrier = options.external ? Carrier::kInProcess : Carrier::kLocal;
  options.program = program_;
  // The loop's rights are of a thread of its own and end with it; the memory's are given back.
  RunResult result;
  std::exception_ptr trouble;
  std::thread([&] {
    try {
      result = run_experiment(*fixture_, options);
    } catch (...) {
      trouble = std::current_exception();
    }
  }).join();
  (void)munlockall();
  if (trouble) {
    std::rethrow_exception(trouble);
  }
  return result;
}

void Session::run(std::uint64_t seed) {
  share_processor();
  State over = state();
  over.phase = Phase::kOver;
  try {
    const auto result = run_by_its_clock(seed);
    set(Phase::kJudging);
    const auto written = write_report(result.folder);
    over.folder = result.folder.filename().string();
    over.verdict = result.complete ? std::string(name_of(result.judgement.verdict)) : "";
    over.reason = result.complete ? first_trouble(result.judgement) : result.reason;
    if (over.reason.empty()) {
      over.reason = result.judgement.judged;
    }
    over.timing = result.timing;
    if (written && !written->contradictions.empty()) {
      over.verdict = std::string(name_of(Verdict::kInvalid));
      over.reason = written->contradictions.front();
    }
    if (!written) {
      over.reason += (over.reason.empty() ? "no report: " : "; no report: ") + written.error();
    }
  } catch (const std::exception& error) {
    over.reason = error.what();
  }
  const std::lock_guard lock(mutex_);
  state_ = over;
}

void Session::set(Phase phase) {
  const std::lock_guard lock(mutex_);
  state_.phase = phase;
}

void Session::cut_short() {
  stop_ = true;
  if (operator_ != nullptr) {
    operator_->wake();
  }
  if (thread_.joinable()) {
    thread_.join();
  }
}

Session::State Session::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

RunOperator* Session::operator_if_running() noexcept {
  return state().phase == Phase::kRunning ? operator_.get() : nullptr;
}

void Session::type(const std::string& text) {
  auto& operator_here = run_operator();
  if (!fixture_->experiment.reference.empty()) {
    const auto line = text.substr(0, text.find_last_not_of(" \r\n") + 1);
    if (line != "reset") {
      throw FixtureError({.file = "panel"}, '"' + line + '"',
                         "`reset`, the operator's: this controller has no console here");
    }
  }
  operator_here.type(text);
}

RunOperator& Session::run_operator() {
  if (auto* const run_operator = operator_if_running()) {
    return *run_operator;
  }
  throw FixtureError({.file = "panel"}, "a command to a run", "a run under way; there is none");
}

}  // namespace towbench::harness
