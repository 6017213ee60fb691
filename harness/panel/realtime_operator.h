// A person at a run by the wall clock: types, and ends it. Nothing else can be done to a clock that
// does not wait, and a fault is judged beside a reference run of the same bits, which such a run
// has not.
//
// The loop never waits for the person: keys come through a lock-free queue.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/spsc_queue.h"
#include "harness/panel/run_operator.h"

namespace towbench::harness {

class RealtimeOperator final : public RunOperator {
 public:
  // `before`: what was done before the start.
  RealtimeOperator(std::vector<OperatorAct> before, bool holds);

  void type(std::string bytes) override;
  void finish() override;
  void wake() override {}
  [[noreturn]] void inject_now(Fault fault) override;
  [[noreturn]] void clear(const FaultPlace& place, FaultKind kind) override;
  [[noreturn]] void set_speed(double speed) override;
  [[noreturn]] void pause(bool paused) override;
  [[noreturn]] void step(core::Nanoseconds length_ns) override;

  [[nodiscard]] Pace pace() const override { return {}; }
  [[nodiscard]] std::vector<std::string> active_faults() const override { return {}; }
  [[nodiscard]] std::string take_trouble() override { return {}; }

  // ---- on the bench's thread ----
  [[nodiscard]] std::span<const OperatorAct> at(core::Nanoseconds now_ns,
                                                SteeredBench& bench) override;
  [[nodiscard]] bool holds() const override { return holds_; }
  [[nodiscard]] const std::vector<OperatorAct>& done() const override { return done_; }
  [[nodiscard]] const FaultPlan& injected() const override { return injected_; }

 private:
  static constexpr std::size_t kMostActs = 4096;
  struct Keys {
    OperatorAct::Kind kind = OperatorAct::Kind::kTyped;
    std::uint8_t size = 0;
    std::array<char, 118> bytes{};
    [[nodiscard]] std::string_view text() const noexcept { return {bytes.data(), size}; }
  };

  const bool holds_;
  core::SpscQueue<Keys, 64> keys_;
  std::vector<OperatorAct> done_;
  std::size_t told_ = 0;
  FaultPlan injected_;  // nothing, ever
};

}  // namespace towbench::harness
