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

class Operator {
 public:
  Operator() = default;
  Operator(const Operator&) = delete;
  Operator& operator=(const Operator&) = delete;
  virtual ~Operator() = default;

  // Asked once an exchange, before the controller is served; may wait, which the run does not see.
  // What is injected has been given to the bench when it returns. The acts live until the next
  // call.
  [[nodiscard]] virtual std::span<const OperatorAct> at(core::Nanoseconds now_ns,
                                                        SteeredBench& bench) = 0;
  // Whether the run goes on after its script, until it is finished by hand or its time is over.
  [[nodiscard]] virtual bool holds() const = 0;
};

// One that acts while the run is under way, and reports its acts when the run is over.
class InteractiveOperator : public Operator {
 public:
  [[nodiscard]] virtual const std::vector<OperatorAct>& done() const = 0;
  // The faults, each from a set time on.
  [[nodiscard]] virtual const FaultPlan& injected() const = 0;
};

// Repeats recorded acts. Faults are the bench's to make: they stand in the experiment.
class ReplayedOperator final : public Operator {
 public:
  // In order of time.
  explicit ReplayedOperator(std::vector<OperatorAct> acts) : acts_(std::move(acts)) {}

  [[nodiscard]] std::span<const OperatorAct> at(core::Nanoseconds now_ns,
                                                SteeredBench& /*bench*/) override {
    const std::size_t first = next_;
    while (next_ < acts_.size() && acts_[next_].time_ns <= now_ns) {
      ++next_;
    }
    return std::span(acts_).subspan(first, next_ - first);
  }
  [[nodiscard]] bool holds() const override {
    return std::any_of(acts_.begin(), acts_.end(), [](const OperatorAct& act) {
      return act.kind == OperatorAct::Kind::kHolds;
    });
  }

 private:
  std::vector<OperatorAct> acts_;
  std::size_t next_ = 0;
};

}  // namespace towbench::harness
