// A person at the bench while an experiment runs: what is done besides the script, in virtual time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/time.h"
#include "harness/experiment/operator_act.h"
#include "harness/fault_plan/fault.h"
#include "harness/lockstep/steered_bench.h"

namespace towbench::harness {

class Hand {
 public:
  Hand() = default;
  Hand(const Hand&) = delete;
  Hand& operator=(const Hand&) = delete;
  virtual ~Hand() = default;

  // Asked once an exchange, before the controller is served; may wait, which the run does not see.
  // What is broken has been given to the bench when it returns. The acts live until the next call.
  [[nodiscard]] virtual std::span<const HandAct> at(core::Nanoseconds now_ns,
                                                    SteeredBench& bench) = 0;
  // Whether the run goes on after its script, until it is finished by hand or its time is over.
  [[nodiscard]] virtual bool holds() const = 0;
};

// One that does something of its own will; when the run is over it tells what.
class FreeHand : public Hand {
 public:
  [[nodiscard]] virtual const std::vector<HandAct>& done() const = 0;
  // What it broke, each from a set time on.
  [[nodiscard]] virtual const FaultPlan& broke() const = 0;
};

// Does again what was done. Faults are the bench's to make: they stand in the experiment.
class RepeatedHand final : public Hand {
 public:
  // In order of time.
  explicit RepeatedHand(std::vector<HandAct> acts) : acts_(std::move(acts)) {}

  [[nodiscard]] std::span<const HandAct> at(core::Nanoseconds now_ns,
                                            SteeredBench& /*bench*/) override {
    const std::size_t first = next_;
    while (next_ < acts_.size() && acts_[next_].time_ns <= now_ns) {
      ++next_;
    }
    return std::span(acts_).subspan(first, next_ - first);
  }
  [[nodiscard]] bool holds() const override {
    return std::any_of(acts_.begin(), acts_.end(),
                       [](const HandAct& act) { return act.kind == HandAct::Kind::kHolds; });
  }

 private:
  std::vector<HandAct> acts_;
  std::size_t next_ = 0;
};

}  // namespace towbench::harness
