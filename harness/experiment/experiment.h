// What an experiment file says: which machine, which controller, what is typed and what happens to
// the machine when, and what must come out.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "emulator/faults/scheduled_event.h"
#include "harness/experiment/board_plan.h"
#include "harness/experiment/operator_act.h"
#include "harness/experiment/reference.h"
#include "harness/fault_plan/fault.h"
#include "harness/requirements/requirement.h"

namespace towbench::harness {

// One line of the conversation with the controller's console, in virtual time. In this order: wait
// until `at_s`, type `send`, wait for `expect` in what the console printed since then, then for
// what `wait` names.
struct ConsoleStep {
  std::optional<double> at_s{};  // from the start of the run
  std::string send{};            // a carriage return is added; empty: nothing is typed
  std::string expect{};          // a substring of the output; empty: nothing is expected
  bool wait_idle = false;        // until no motion runs
  double wait_s = 0;             // at last, this much longer
  double timeout_s = 30;         // for `expect` and `wait` together
};

// A stretch of the run over which metrics are computed. "whole" always exists.
struct EvaluationWindow {
  enum class Origin : std::uint8_t { kRun, kMotion };  // time 0, or the first drive of any axis
  std::string name = "whole";
  Origin origin = Origin::kRun;
  double from_s = 0;
  double to_s = std::numeric_limits<double>::max();
};

// What a metric over a window must be. Two sides where too good would be suspicious.
struct Budget {
  std::string metric{};
  std::string window = "whole";
  std::optional<double> min{};
  std::optional<double> max{};
  std::string source{};  // where the figure comes from
};

struct Experiment {
  std::string name;
  std::string title;
  std::string description;
  double duration_limit_s = 60;
  std::uint64_t seed = 1;
  double logger_rate_Hz = 0;                     // of logger.csv; 0: there is none
  std::vector<ConsoleStep> console;              // of BBMC; none with a reference
  std::vector<ReferenceMotion> reference;        // sorted by time
  std::vector<emulator::ScheduledEvent> events;  // sorted by time
  FaultPlan faults;
  BoardPlan board;
  std::vector<OperatorAct> operator_acts;  // sorted by time; empty: nobody interfered
  std::vector<EvaluationWindow> windows;   // the first is "whole"
  std::vector<Budget> budgets;
  std::vector<Requirement> requirements;
  bool budgets_apply = true;  // not to a machine that was broken on the command line or by hand
};

}  // namespace towbench::harness
