#include "harness/lockstep/script_loop.h"

#include <chrono>
#include <optional>

#include <fmt/format.h>

#include "harness/lockstep/console_script.h"

namespace towbench::harness {
namespace {

using HostClock = std::chrono::steady_clock;

core::Nanoseconds since(HostClock::time_point start) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(HostClock::now() - start).count();
}

std::string told(core::ErrorCode code) {
  return fmt::format("{} ({})", core::describe(code), core::number_of(code));
}

class Loop {
 public:
  Loop(const Experiment& experiment, LockstepBench& bench, BenchRecorder& recorder,
       const LoopWatchers& watchers, RunEnd end, Operator* run_operator)
      : operator_(run_operator),
        end_(end),
        bench_(bench),
        recorder_(recorder),
        watchers_(watchers),
        script_(experiment.console),
        limit_ns_(core::nanoseconds(experiment.duration_limit_s)) {}

  RunOutcome run() {
    const auto start = HostClock::now();
    if (const auto agreed = bench_.start(); !agreed) {
      outcome_.reason = "handshake refused: " + told(agreed.error());
    } else {
      exchange_until_over(start);
    }
    outcome_.wall_time_s = core::seconds(since(start));
    outcome_.end_ns = bench_.now_ns();
    outcome_.exchange_ns = bench_.controller().exchange_ns();
    outcome_.rows_lost = bench_.controller().rows_lost();
    return outcome_;
  }

 private:
  void exchange_until_over(HostClock::time_point start) {
    core::Nanoseconds last_host_ns = since(start);
    while (!turn_is_last()) {
      if (const auto alive = bench_.advance(); !alive) {
        outcome_.reason = "the emulator was lost: " + told(alive.error());
        return;
      }
      const core::Nanoseconds host_ns = since(start);
      recorder_.timing(bench_.now_ns(), host_ns, host_ns - last_host_ns);
      last_host_ns = host_ns;
      tell_progress();
    }
    bench_.finish();
  }

  // Serves the controller once; true when the run is over with that.
  bool turn_is_last() {
    if (!script_is_over_) {
      script_is_over_ = script_ends();
    } else {
      bench_.serve();
      if (stopped()) {
        outcome_.complete = false;
      }
    }
    return script_is_over_ && (!outcome_.complete || settled());
  }

  bool stopped() {
    if (watchers_.stop == nullptr || !watchers_.stop->load(std::memory_order_relaxed)) {
      return false;
    }
    outcome_.reason = "interrupted";
    return true;
  }

  // Whether the machine can be expected to stand, or need not be waited for any more.
  bool settled() {
    const auto now_ns = bench_.now_ns();
    if (script_over_ns_ < 0) {
      script_over_ns_ = now_ns;
    }
    const bool rests = end_ == RunEnd::kIdle && bench_.controller().idle();
    return rests || bench_.undriven_ns() >= kCoasting_ns ||
           now_ns - script_over_ns_ >= kLongestSettling_ns;
  }

  bool script_ends() {
    const auto now_ns = bench_.now_ns();
    const bool finished = take_operator_acts(now_ns);
    type(now_ns);
    script_.hear(bench_.serve());
    const auto progress = script_.update(now_ns, bench_.controller().idle());
    if (stopped()) {
      return true;
    }
    const bool scripted = progress == ConsoleScript::Progress::kRunning;
    const bool goes_on = scripted || (operator_ != nullptr && operator_->holds());
    if (goes_on && !finished && now_ns < limit_ns_) {
      return false;
    }
    outcome_.complete = true;
    outcome_.script_failure = disturbed_ ? "" : script_.failure();
    if (scripted && !disturbed_) {
      outcome_.script_failure = fmt::format(
          "{} in step {} of {}; it had not ended",
          finished ? "finished by hand"
                   : fmt::format("the time limit of {} s came", core::seconds(limit_ns_)),
          script_.steps_done() + 1, script_.steps());
    }
    return true;
  }

  // True when the run is to end.
  bool take_operator_acts(core::Nanoseconds now_ns) {
    bool finished = false;
    if (operator_ != nullptr) {
      for (const auto& act : operator_->at(now_ns, bench_)) {
        recorder_.operator_acted(act);
        const bool of_machine = act.disturbs() || act.kind == OperatorAct::Kind::kFinished;
        end_ = of_machine ? RunEnd::kUndriven : end_;
        disturbed_ = disturbed_ || act.disturbs();
        by_hand_ += act.kind == OperatorAct::Kind::kTyped ? act.text : "";
        finished = finished || act.kind == OperatorAct::Kind::kFinished;
      }
    }
    return finished;
  }

  // What is typed by hand waits for the end of the script's line, and the script for the hand's.
  void type(core::Nanoseconds now_ns) {
    if (!by_hand_.empty() && !script_in_line_) {
      const auto taken = bench_.controller().type(by_hand_);
      recorder_.typed(now_ns, std::string_view(by_hand_).substr(0, taken));
      by_hand_.erase(0, taken);
      return;
    }
    const auto pending = script_.pending(now_ns);
    const auto taken = bench_.controller().type(pending);
    recorder_.typed(now_ns, pending.substr(0, taken));
    script_in_line_ = taken < pending.size() && (taken > 0 || script_in_line_);
    script_.typed(taken);
  }

  void tell_progress() {
    constexpr std::uint32_t kExchangesBetween = 4096;
    if (watchers_.progress && ++exchanges_ % kExchangesBetween == 0) {
      watchers_.progress(bench_.now_ns());
    }
  }

  Operator* operator_;  // null: nobody
  RunEnd end_;
  bool script_is_over_ = false;
  core::Nanoseconds script_over_ns_ = -1;
  std::string by_hand_;
  bool disturbed_ = false;  // the script may wait in vain for what it expects
  bool script_in_line_ = false;
  LockstepBench& bench_;
  BenchRecorder& recorder_;
  const LoopWatchers& watchers_;
  ConsoleScript script_;
  core::Nanoseconds limit_ns_;
  RunOutcome outcome_;
  std::uint32_t exchanges_ = 0;
};

}  // namespace

RunOutcome play(const Experiment& experiment, LockstepBench& bench, BenchRecorder& recorder,
                const LoopWatchers& watchers, RunEnd end, Operator* run_operator) {
  std::optional<ReplayedOperator> repeated;
  if (run_operator == nullptr && !experiment.operator_acts.empty()) {
    run_operator = &repeated.emplace(experiment.operator_acts);
  }
  auto outcome = Loop(experiment, bench, recorder, watchers, end, run_operator).run();
  recorder.flush();
  outcome.log_rows = recorder.rows();
  outcome.writes_succeeded = recorder.good();
  return outcome;
}

}  // namespace towbench::harness
