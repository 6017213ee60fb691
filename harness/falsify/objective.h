// By how much one run with faults, in a setup, keeps what is asked of it.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/campaign/candidate_controller.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/falsify/fault_space.h"

namespace towbench::harness {

struct Outcome {
  bool fired = false;              // each fault took effect; else nothing was tried
  std::optional<double> margin{};  // none: no occasion
  bool broken = false;
  std::string reason{};
  // Of each rule that had an occasion, where the rules are asked; the smallest is `margin`.
  std::map<std::string, double> rules{};
};

// What is asked: a requirement of the experiment, or the rules that hold whatever fails
// (docs/theory/safety.md): of each the share of its limit that is left, -1 for one without a limit
// that is broken, 1 for one that is kept; and the smallest of them as one number.
struct Asked {
  std::optional<Requirement> requirement{};  // none: the rules
  [[nodiscard]] std::string name() const { return requirement ? requirement->id : "rules"; }
  [[nodiscard]] std::string text() const {
    return requirement ? requirement->text : "the rules of docs/theory/safety.md";
  }
  [[nodiscard]] std::string unit() const {
    return requirement && requirement->parsed.unit != "1" ? requirement->parsed.unit : "";
  }
};

class Objective {
 public:
  Objective() = default;
  Objective(const Objective&) = delete;
  Objective& operator=(const Objective&) = delete;
  virtual ~Objective() = default;

  // Every fault begins at a time that is given. Without one, what is asked is a requirement. Never
  // throws for a case that cannot be: it did not fire.
  [[nodiscard]] virtual Outcome measure(const SearchCase& one) = 0;
  // Where the fault-free run ends.
  [[nodiscard]] virtual double end_s() const = 0;
  // Of the fault-free motion that such a fault goes by, as shares of the time to its end.
  [[nodiscard]] virtual std::vector<Stretch> phases_of(const FaultChoice& choice) const = 0;
};

// BBMC in this process. With `snapshots` each run goes on from one of so many of the fault-free
// run, else it begins anew. Throws FixtureError when the run without faults does not come to its
// end.
[[nodiscard]] std::unique_ptr<Objective> in_process_objective(const ExperimentFixture& fixture,
                                                              Asked asked, std::size_t snapshots);
// A program of its own or an image, each run from its start.
[[nodiscard]] std::unique_ptr<Objective> candidate_objective(const ExperimentFixture& fixture,
                                                             Asked asked,
                                                             CandidateController controller);

}  // namespace towbench::harness
