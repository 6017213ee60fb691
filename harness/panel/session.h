// One run at a time, on a thread of its own, as the panel starts it.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "harness/panel/live_tap.h"
#include "harness/panel/run_operator.h"
#include "harness/run/experiment_run.h"

namespace towbench::harness {

struct SessionStart {
  std::string experiment;                                    // name or path, as on the command line
  std::vector<std::pair<std::size_t, std::string>> lines{};  // instead of the script's, by index
  std::vector<std::string> faults{};                         // in words
  std::optional<std::uint64_t> seed{};
  std::optional<double> duration_limit_s{};
  // kReal: two processes over a local socket, each by the wall clock; no faults, no other pace.
  RunClock clock = RunClock::kLockstep;
  RunOperator::Pace pace{};
  bool holds = false;  // goes on after its script until finished by hand
};

class Session {
 public:
  enum class Phase : std::uint8_t { kIdle, kRunning, kJudging, kOver };
  struct State {
    Phase phase = Phase::kIdle;
    std::uint64_t number = 0;  // of the run since the panel started
    std::string name{};
    std::string title{};
    RunClock clock = RunClock::kLockstep;
    std::string timing{};   // by the wall clock, over: how both loops kept time, in words
    std::string folder{};   // below the runs' folder; of a run that is over
    std::string verdict{};  // PASS, FAIL, INVALID, or empty
    std::string reason{};   // why there is none, or the first check that did not hold
  };

  // Run folders come below `runs`. `controller` runs the experiments that state their reference,
  // which are refused without one. `program` emulates the machine of a run by the wall clock; it
  // knows the verb `emulate`.
  explicit Session(std::filesystem::path runs, std::optional<ExternalController> controller = {},
                   std::filesystem::path program = "/proc/self/exe")
      : runs_(std::move(runs)), controller_(std::move(controller)), program_(std::move(program)) {}
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session() { cut_short(); }

  // Throws FixtureError when a run is under way or the fixtures will not do.
  void start(const SessionStart& wanted);
  // The run ends at once and stays incomplete. Returns when it has.
  void cut_short();

  [[nodiscard]] State state() const;
  [[nodiscard]] LiveTap& tap() noexcept { return tap_; }
  // Of the run under way. Throws FixtureError when there is none.
  [[nodiscard]] RunOperator& run_operator();
  // On the console of the run under way; where there is none, the operator's `reset` alone. Throws
  // FixtureError.
  void type(const std::string& text);
  // Null when none is under way.
  [[nodiscard]] RunOperator* operator_if_running() noexcept;
  // Of the last run started; null before.
  [[nodiscard]] const ExperimentFixture* fixture() const noexcept { return fixture_.get(); }
  [[nodiscard]] const std::filesystem::path& runs() const noexcept { return runs_; }
  [[nodiscard]] const std::optional<ExternalController>& controller() const noexcept {
    return controller_;
  }

 private:
  void run(std::uint64_t seed);
  [[nodiscard]] RunResult run_by_its_clock(std::uint64_t seed);
  void set(Phase phase);

  std::filesystem::path runs_;
  std::optional<ExternalController> controller_;
  std::filesystem::path program_;
  LiveTap tap_;
  std::unique_ptr<ExperimentFixture> fixture_;
  std::unique_ptr<RunOperator> operator_;
  std::atomic<bool> stop_{false};
  mutable std::mutex mutex_;
  State state_;
  std::thread thread_;
};

}  // namespace towbench::harness
