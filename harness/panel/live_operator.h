// The operator at the panel of a run: commands come from the server's thread, take effect on the
// bench's thread between two exchanges, and are written down with the exchange's virtual time.
//
// Also holds the run back to a pace: paused, step by step, slow motion, real time, or not at all.
// That is host time, which the run does not see.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "harness/experiment/experiment_fixture.h"
#include "harness/lockstep/operator.h"
#include "harness/panel/run_operator.h"

namespace towbench::harness {

class LiveOperator final : public RunOperator {
 public:
  // `fixture` as it is run. `stop`: the run is to be cut short. Both outlive this.
  LiveOperator(const ExperimentFixture& fixture, std::uint64_t seed, Pace pace, bool holds,
               const std::atomic<bool>& stop);

  // ---- from any thread ----
  void type(std::string bytes) override;
  // Throws for what the machine has not, what is built in from the start, and what is injected so
  // already.
  void inject_now(Fault fault) override;
  void clear(const FaultPlace& place, FaultKind kind) override;
  void set_speed(double speed) override;
  void pause(bool paused) override;
  void step(core::Nanoseconds length_ns) override;
  void finish() override;
  void wake() override { changed_.notify_all(); }

  [[nodiscard]] Pace pace() const override;
  [[nodiscard]] core::Nanoseconds now_ns() const noexcept {
    return now_ns_.load(std::memory_order_relaxed);
  }
  [[nodiscard]] std::vector<std::string> active_faults() const override;
  [[nodiscard]] std::string take_trouble() override;

  // ---- on the bench's thread ----
  [[nodiscard]] std::span<const OperatorAct> at(core::Nanoseconds now_ns,
                                                SteeredBench& bench) override;
  [[nodiscard]] bool holds() const override { return holds_; }
  // Both when the run is over.
  [[nodiscard]] const std::vector<OperatorAct>& done() const override { return done_; }
  [[nodiscard]] const FaultPlan& injected() const override { return injected_; }

 private:
  using HostClock = std::chrono::steady_clock;
  struct Command {
    OperatorAct::Kind kind = OperatorAct::Kind::kClock;
    std::string text;
    std::optional<Fault> fault;
  };

  void give(Command command);
  void carry_out(const Command& command, core::Nanoseconds now_ns, SteeredBench& bench);
  [[nodiscard]] std::string start_fault(const Fault& fault, SteeredBench& bench);
  [[nodiscard]] std::string end_fault(const Fault& fault, SteeredBench& bench);
  [[nodiscard]] Injection injection_of(const Fault& fault) const;
  void note(OperatorAct::Kind kind, std::string text);
  // Until when the pace says to wait; none: not at all.
  [[nodiscard]] std::optional<HostClock::time_point> due(core::Nanoseconds now_ns);

  const ExperimentFixture& fixture_;
  std::uint64_t seed_;
  const bool holds_;
  const std::atomic<bool>& stop_;
  std::atomic<core::Nanoseconds> now_ns_{0};
  // Something to carry out or a pace to keep; else the bench's thread takes no lock and reads no
  // clock. Changed under the mutex.
  std::atomic<bool> wanted_{true};

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Command> commands_;
  Pace pace_;
  core::Nanoseconds step_until_ns_ = -1;
  HostClock::time_point anchor_host_{};
  core::Nanoseconds anchor_ns_ = -1;  // none: to be taken at the next exchange
  std::string trouble_;

  std::vector<OperatorAct> done_;
  std::size_t told_ = 0;  // acts of done_ that the loop has had
  FaultPlan injected_;
};

}  // namespace towbench::harness
